#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/suite.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::eval {

/// A row as the paper prints it.
struct PublishedRow {
  std::string_view title;
  double collision_loss = 0.0;
  double false_trigger_loss = 0.0;
};

/// A table of the paper, and the scenes that it is of.
struct PaperTable {
  std::string_view name;        ///< as commands have it
  std::string_view title;       ///< for readers
  std::string_view conditions;  ///< likewise: which scenes these are
  std::string_view risk;        ///< a shipped scenario
  std::string_view free;        ///< the same without risk
  std::string_view speeds;      ///< of the ego, as parse_axis takes them; empty: the scenario's
  std::span<const PublishedRow> published;
};

/// II and III, and between them II with a truck that comes late, which is ours.
/// Source: arXiv 2504.00115, section V.
[[nodiscard]] std::span<const PaperTable> paper_tables();
/// nullptr: there is none of that name.
[[nodiscard]] const PaperTable* find_paper_table(std::string_view name);

/// Average and least, as the paper prints them.
struct PublishedReplies {
  std::string_view table;  ///< its name
  double tokens = 0.0;
  double seconds = 0.0;
  double least_seconds = 0.0;
};
/// Table IV: how long the paper's model takes for a reply, in the scenes of II and III.
[[nodiscard]] std::span<const PublishedReplies> published_replies();

/// One encounter for each condition of a table, with its twin without risk.
/// @param scenarios  the folder of those that are shipped
/// @return           what cannot be read or varied, naming it
[[nodiscard]] Result<std::vector<SuiteEncounter>> encounters_of(
    const PaperTable& table, const std::filesystem::path& scenarios, const manoeuvre::Car& car);

}  // namespace saca::eval

#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/suite_running.h"
#include "saca/lab/eval/paper_tables.h"
#include "saca/lab/eval/reply_timing.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/report/suite_page.h"

namespace saca::app {

constexpr int few_draws = 10;  // of each condition, as in the paper

/// As `--table` and the figures have it: "2_late".
[[nodiscard]] std::string number_of(const eval::PaperTable& table);

/// The figures of one table: of the first draws of each condition, of all, and of each method that
/// asks a model over the encounters in which all replies to it came in time.
struct TableFigures {
  const eval::PaperTable* table = nullptr;
  std::vector<eval::MethodFigures> few;
  std::vector<eval::MethodFigures> all;
  std::vector<std::optional<eval::MethodFigures>> in_time;  ///< of methods that ask a model
  std::string page;                                         ///< of its encounters, beside the index
};

/// @param few  how many of the first encounters the paper's number of draws is
[[nodiscard]] TableFigures table_figures(const eval::PaperTable& table, const SuiteRun& run,
                                         std::size_t few, std::uint64_t seed);

/// Replies of one model in the scenes of one table.
struct TimedModel {
  std::string table;  ///< its name
  std::string title;  ///< of the model
  std::string key;    ///< of the figures
  eval::ReplyTimes times;
};

/// Published and ours side by side, with a chart.
[[nodiscard]] report::PageTable page_table(const TableFigures& figures);
/// Table IV likewise.
[[nodiscard]] report::PageTable replies_table(const std::vector<TimedModel>& timed);

/// Under the names of docs/formats.md.
void add_figures(nlohmann::json& out, const TableFigures& figures);
void add_figures(nlohmann::json& out, const TimedModel& one);

}  // namespace saca::app

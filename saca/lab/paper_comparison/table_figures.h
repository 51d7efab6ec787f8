#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/eval/paper_tables.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/suites/suite_run.h"

namespace saca::paper_comparison {

/// The figures of one table: of the first draws of each condition, of all, and of each method that
/// asks a model over the encounters in which every reply ended by itself before T1, as far as
/// replies are charged time in lockstep.
struct TableFigures {
  const eval::PaperTable* table = nullptr;
  std::vector<eval::MethodFigures> few;
  std::vector<eval::MethodFigures> all;
  std::vector<std::optional<eval::MethodFigures>> in_time;  ///< of methods that ask a model
  std::string page;                                         ///< of its encounters, beside the index
};

/// @param few  how many of the first encounters the paper's number of draws is
/// @return     `few` is empty where none of these could be played
[[nodiscard]] TableFigures table_figures(const eval::PaperTable& table, const suites::SuiteRun& run,
                                         std::size_t few, std::uint64_t seed);

}  // namespace saca::paper_comparison

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/eval/paper_tables.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/thinking_options.h"

namespace saca::paper_comparison {

constexpr int few_draws = 10;  // of each condition, as in the paper

/// Which tables of the paper are made again, and with what.
struct TableRequest {
  int count = 1'000;  ///< encounters of each table, at least
  std::uint64_t seed = 1;
  int threads = usual_threads();
  suites::ThinkingOptions thinking;
  std::string methods;                 ///< names, separated by commas; empty: compared_methods
  std::string output = "runs/tables";  ///< folder
  std::vector<std::string> only;       ///< numbers of tables; empty: all
};

/// As `--table` and the figures have it: "2_late".
[[nodiscard]] std::string number_of(const eval::PaperTable& table);

[[nodiscard]] bool is_wanted(const eval::PaperTable& table, const TableRequest& request);

/// SACA and the paper's algorithm with all that is given and without each part of it; beside them
/// the paper's baseline, published rules, and what could be had.
[[nodiscard]] std::vector<std::string> compared_methods(const suites::ThinkingOptions& thinking);

/// The first encounters that are the paper's number of draws.
/// @param num_conditions  of the table
[[nodiscard]] int num_few(std::size_t num_conditions);

/// The encounters of a table as a suite, which a journal goes on with: as many of each condition.
[[nodiscard]] suites::SuiteRequest suite_of(const eval::PaperTable& table,
                                            std::size_t num_conditions,
                                            const TableRequest& request);

/// The command that makes the same again, for records.
[[nodiscard]] std::string command_text(const TableRequest& request);

}  // namespace saca::paper_comparison

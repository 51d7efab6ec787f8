#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/installation/installation.h"
#include "saca/lab/paper_comparison/reply_clock.h"
#include "saca/lab/paper_comparison/table_figures.h"
#include "saca/lab/paper_comparison/table_request.h"

namespace saca::paper_comparison {

/// One table that was run.
struct TableRun {
  TableFigures figures;  ///< without `few` where none of these could be played
  int num_few = 0;       ///< the paper's number of encounters
  nlohmann::json made;   ///< "meta...." of the run
  std::string failures;  ///< suites::failures_text of all its encounters
};

/// Runs a table with the car of the paper's scenes, or what is left of it, and leaves its rows and
/// their page in the request's folder, but where `figures` is without `few`.
/// @param methods  names of eval::methods(), in the order of tables
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<TableRun>> run_table(const installation::Installation& here,
                                                        const eval::PaperTable& table,
                                                        const TableRequest& request,
                                                        const std::vector<std::string>& methods);

/// Table IV: timed_models with the program's own models and car.
[[nodiscard]] Result<std::vector<TimedModel>> time_replies(const installation::Installation& here,
                                                           const TableRequest& request);

}  // namespace saca::paper_comparison

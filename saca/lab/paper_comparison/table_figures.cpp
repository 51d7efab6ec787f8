#include "saca/lab/paper_comparison/table_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "saca/lab/suites/method_list.h"

namespace saca::paper_comparison {
namespace {

using eval::MethodFigures;
using eval::SuiteRow;

std::vector<MethodFigures> figures_of(const std::vector<const SuiteRow*>& rows,
                                      const std::vector<std::string>& methods, std::uint64_t seed) {
  return eval::suite_figures(rows, methods, suites::index_of(methods, "aeb"), seed);
}

/// Like the paper's filter: was the model asked, and did each of its replies end by itself before
/// the trigger that it was about? One that was stopped at its last token did not.
bool is_in_time(const eval::MethodRun& run) {
  return run.thinking && run.thinking->asked > 0 && run.thinking->ended == run.thinking->asked;
}

}  // namespace

TableFigures table_figures(const eval::PaperTable& table, const suites::SuiteRun& run,
                           std::size_t few, std::uint64_t seed) {
  TableFigures figures{.table = &table,
                       .few = {},
                       .all = {},
                       .in_time = {},
                       .page = fmt::format("{}.html", table.name)};
  std::vector<const SuiteRow*> rows;
  for (const SuiteRow& row : run.rows) {
    rows.push_back(&row);
  }
  figures.all = figures_of(rows, run.methods, seed);
  figures.in_time.resize(run.methods.size());
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    std::vector<const SuiteRow*> answered;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(answered), [&](const SuiteRow* row) {
      return counts_in_figures(*row) && is_in_time(row->risk.runs[m]);
    });
    if (!answered.empty()) {
      figures.in_time[m] = figures_of(answered, run.methods, seed)[m];
    }
  }
  rows.resize(std::min(few, rows.size()));
  figures.few = figures_of(rows, run.methods, seed);
  return figures;
}

}  // namespace saca::paper_comparison

#include "saca/lab/suites/suite_result.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "saca/lab/suites/method_list.h"

namespace saca::suites {
namespace {

using eval::SuiteRow;

std::vector<const SuiteRow*> rows_of_family(const SuiteRun& run, const std::string& family) {
  std::vector<const SuiteRow*> found;
  for (const SuiteRow& row : run.rows) {
    if (family.empty() || row.family == family) {
      found.push_back(&row);
    }
  }
  return found;
}

}  // namespace

SuiteResult result_of(const SuiteRun& run, std::uint64_t seed) {
  SuiteResult result;
  const auto aeb = index_of(run.methods, "aeb");
  std::set<std::string> families;
  for (const SuiteRow& row : run.rows) {
    result.faults += row.fault.empty() ? 0 : 1;
    result.method_faults += row.fault.empty() && !counts_in_figures(row) ? 1 : 0;
    families.insert(row.family);
  }
  result.all = eval::suite_figures(rows_of_family(run, ""), run.methods, aeb, seed);
  for (const std::string& family : families) {
    result.families[family] =
        eval::suite_figures(rows_of_family(run, family), run.methods, aeb, seed);
  }
  return result;
}

std::string failures_text(const SuiteRun& run) {
  int left_out = 0;
  std::string first;
  for (const SuiteRow& row : run.rows) {
    if (const auto failure = failure_of(row, run.methods)) {
      first = left_out == 0 ? fmt::format("encounter {} {}", row.number, *failure) : first;
      ++left_out;
    }
  }
  return left_out == 0 ? ""
                       : fmt::format("{} of {} encounters are left out; the first: {}", left_out,
                                     run.rows.size(), first);
}

DriverFigures driver_figures(const SuiteRun& run) {
  DriverFigures figures;
  figures.agreement.resize(run.methods.size());
  for (const SuiteRow& row : run.rows) {
    if (!counts_in_figures(row) || !row.driver) {
      continue;
    }
    ++figures.count;
    figures.harm += row.driver->harm;
    figures.met += row.driver->met ? 1 : 0;
    figures.braked += row.driver->brakes ? 1 : 0;
    figures.steered += row.driver->steers != 0 ? 1 : 0;
    if (!row.driver->met) {
      ++figures.met_nobody;
      for (std::size_t m = 0; m < run.methods.size(); ++m) {
        figures.agreement[m] += eval::agrees(*row.driver, row.risk.runs[m].plan) ? 1.0 : 0.0;
      }
    }
  }
  figures.harm /= std::max(1, figures.count);
  for (double& agreement : figures.agreement) {
    agreement /= std::max(1, figures.met_nobody);
  }
  return figures;
}

}  // namespace saca::suites

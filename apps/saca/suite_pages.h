#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/suite_running.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/report/suite_page.h"

namespace saca::app {

/// Figures over all, and of each family.
struct SuiteResult {
  std::vector<eval::MethodFigures> all;
  std::map<std::string, std::vector<eval::MethodFigures>> families;
  int faults = 0;         ///< encounters that could not be played
  int method_faults = 0;  ///< of methods that threw
};

/// Of all rows, and of each family's.
[[nodiscard]] SuiteResult result_of(const SuiteRun& run, std::uint64_t seed);

/// Recorded drivers, and how often each method does as they did.
struct DriverFigures {
  int count = 0;      ///< encounters with a recorded driver
  double harm = 0.0;  ///< mean
  int met = 0;        ///< drivers who met somebody
  int braked = 0;
  int steered = 0;
  std::vector<double> agreement;  ///< of each method with the drivers who met nobody, in [0, 1]
};
[[nodiscard]] DriverFigures driver_figures(const SuiteRun& run);

/// A mean with its interval, for readers; "-" where there is none.
[[nodiscard]] std::string with_interval(const eval::Estimate& estimate, int digits,
                                        double factor = 1.0);

/// Under its name, with .lo, .hi and .n; nothing where nothing counts.
void add_estimate(nlohmann::json& out, const std::string& name, const eval::Estimate& estimate);

/// How it was made, for the foot of a page: what "meta...." holds.
[[nodiscard]] std::vector<std::string> footnotes_of(const nlohmann::json& meta);

/// The page of a suite: what there is to see, in sentences; harm, all figures, families, where
/// decisions came from, and the encounters in which the first method lost most.
[[nodiscard]] report::SuitePage page_of(const SuiteRun& run, const SuiteResult& result,
                                        const SuiteCommandOptions& options);

/// The rows into `options.output`, the page beside them.
/// @return  nullopt, else what could not be written
[[nodiscard]] std::optional<Error> write_rows_and_page(const SuiteRun& run,
                                                       const SuiteResult& result,
                                                       const SuiteCommandOptions& options);

}  // namespace saca::app

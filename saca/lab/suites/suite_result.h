#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/suites/suite_run.h"

namespace saca::suites {

/// Figures over all, and of each family.
struct SuiteResult {
  std::vector<eval::MethodFigures> all;
  std::map<std::string, std::vector<eval::MethodFigures>> families;
  int faults = 0;         ///< encounters that could not be played
  int method_faults = 0;  ///< others in which, or in whose twin, a method threw
};

/// Of all rows, and of each family's.
[[nodiscard]] SuiteResult result_of(const SuiteRun& run, std::uint64_t seed);

/// How many encounters are left out, and what went wrong in the first; empty: none is.
[[nodiscard]] std::string failures_text(const SuiteRun& run);

/// Recorded drivers, and how often each method does as they did.
struct DriverFigures {
  int count = 0;       ///< encounters with a recorded driver
  double harm = 0.0;   ///< mean
  int met = 0;         ///< drivers who met somebody
  int met_nobody = 0;  ///< the others, whom methods are held against
  int braked = 0;
  int steered = 0;
  std::vector<double>
      agreement;  ///< of each method with the drivers who met nobody, in [0, 1]; 0 without any
};
[[nodiscard]] DriverFigures driver_figures(const SuiteRun& run);

}  // namespace saca::suites

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/suites/thinking_options.h"
#include "saca/onboard/reflex/trigger.h"

namespace saca::suites {

/// Which encounters are run, and with what.
struct SuiteRequest {
  std::string name;               ///< of a suite, a family or a table of the paper, a folder of
                                  ///< scenarios, or "100car"
  std::vector<std::string> data;  ///< of 100car: the study's folder; of traffic: one or more
  std::string methods;
  int count = 1'000;
  std::string split = "calibration";
  std::string test_log;
  std::string car = "compact_rwd_ev";
  ThinkingOptions thinking;
  reflex::Thresholds thresholds;
  std::string danger;  ///< weights of V_h and Q_h; empty: no method needs them
  std::uint64_t seed = 1;
  bool exact = false;
  bool no_twins = false;
  std::string output;   ///< empty: runs/suite-NAME-SPLIT.h5
  std::string journal;  ///< empty: beside the output
  int threads = usual_threads();
};

}  // namespace saca::suites

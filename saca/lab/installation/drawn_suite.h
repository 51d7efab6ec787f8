#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/eval/survey.h"
#include "saca/lab/installation/inputs.h"

namespace saca::installation {

/// Which encounters of a suite are drawn, and for which car.
struct DrawRequest {
  int count = 1'000;
  std::string split = "calibration";  ///< tuning, calibration or test
  std::string test_log;               ///< where a use of the test split is noted
  std::string car = "compact_rwd_ev";
};

/// What is surveyed: the first encounters of a suite, all eight policies tried in each.
struct SurveyRequest {
  std::string suite = "balanced";
  DrawRequest draw{.count = 2'000, .split = "tuning"};
  std::string journal;  ///< empty: runs/survey-<suite>-<split>.journal
  int threads = usual_threads();
};

/// The line that asks for the same again.
/// @param command  without the program's name
[[nodiscard]] std::string command_line(const SurveyRequest& request, const std::string& command);

/// Adds all that changes what is found in given encounters: the car, the data, the families, and
/// the program itself.
/// @param car  its file, or the name of a shipped one
/// @return  nullopt, else what cannot be read
[[nodiscard]] std::optional<Error> add_inputs(const Installation& here, const std::string& car,
                                              Fnv& hash);

/// A suite that is drawn from, and what its encounters are played with.
struct DrawnSuite {
  Inputs inputs;
  eval::SuiteSource source;
  std::uint64_t digest = 0;  ///< of everything on which encounters and findings depend
};

/// @param command      that asks, for the log of the test split
/// @param other_names  as eval::SuiteDraw has them
[[nodiscard]] Result<DrawnSuite> open_suite(const Installation& here, const std::string& suite,
                                            const DrawRequest& draw, const std::string& command,
                                            std::vector<std::string> other_names = {});
/// The suite of a survey.
[[nodiscard]] Result<DrawnSuite> open_suite(const Installation& here, const SurveyRequest& request,
                                            const std::string& command);

/// eval::survey with progress on the error stream, interrupts, and a journal in runs/ unless the
/// request names one.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<std::vector<eval::Finding>>> survey(
    const Installation& here, const DrawnSuite& suite, const SurveyRequest& request);

}  // namespace saca::installation

#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/inputs.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/survey.h"

namespace saca::app {

/// What is surveyed: the first encounters of a suite, all eight policies tried in each.
struct SurveyOptions {
  std::string suite = "balanced";
  std::string car = "compact_rwd_ev";
  int count = 2'000;
  std::string split = "tuning";
  std::string test_log;
  std::string journal;  ///< empty: runs/survey-<suite>-<split>.journal
  int threads = usual_threads();
  std::vector<std::string> other_names = {};  ///< as eval::SuiteDraw has them
};

/// --count, --split, --test-log and --car: which encounters are drawn, and for which car.
void add_draw_options(CLI::App& command, int& count, std::string& split, std::string& test_log,
                      std::string& car);

void add_survey_options(CLI::App& command, SurveyOptions& options);

/// The line that asks for the same again.
[[nodiscard]] std::string command_line(const SurveyOptions& options, const std::string& command);

/// Adds all that changes what is found in given encounters: the car, the data, the families, and
/// the program itself.
/// @return  nullopt, else what cannot be read
[[nodiscard]] std::optional<Error> add_inputs(const Places& places, const std::string& car,
                                              Fnv& hash);

/// A suite that is drawn from, and what its encounters are played with.
struct DrawnSuite {
  Inputs inputs;
  eval::SuiteSource source;
  std::uint64_t digest = 0;  ///< of everything on which encounters and findings depend
};

/// @param command  that asks, for the log of the test split
[[nodiscard]] Result<DrawnSuite> open_suite(const SurveyOptions& options,
                                            const std::string& command);

/// eval::survey with progress on the error stream, interrupts, and a journal in runs/ unless the
/// options name one.
[[nodiscard]] Result<std::optional<std::vector<eval::Finding>>> survey(
    const DrawnSuite& suite, const SurveyOptions& options);

}  // namespace saca::app

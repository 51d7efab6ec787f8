#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/inputs.h"
#include "saca/core/parallel.h"
#include "saca/eval/survey.h"

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
};

/// --count, --split, --test-log and --car: which encounters are drawn, and for which car.
void add_draw_options(CLI::App& command, int& count, std::string& split, std::string& test_log,
                      std::string& car);

void add_survey_options(CLI::App& command, SurveyOptions& options);

/// The line that asks for the same again.
[[nodiscard]] std::string command_line(const SurveyOptions& options, const std::string& command);

/// The families of a suite, ready to be drawn from.
class SuiteSource {
 public:
  /// @param command  that asks, for the log of the test split
  [[nodiscard]] static Result<SuiteSource> open(const SurveyOptions& options,
                                                const std::string& command);

  [[nodiscard]] const Inputs& inputs() const { return inputs_; }
  /// Encounter `number` of the suite.
  [[nodiscard]] Result<sim::FamilySample> sample(std::uint64_t number) const;
  [[nodiscard]] const std::string& family_of(std::uint64_t number) const;
  /// Of everything on which the encounters depend.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }

 private:
  Inputs inputs_;
  sim::Suite suite_;
  std::vector<sim::Family> families_;  ///< by member of the suite
  std::vector<std::uint64_t> seeds_;   ///< likewise
  std::uint64_t digest_ = 0;
};

/// Looks into all of them, with progress on the error stream and a journal that an interrupted
/// survey goes on from.
/// @return  in the order of their numbers; nullopt: interrupted
[[nodiscard]] Result<std::optional<std::vector<eval::Finding>>> survey(
    const SuiteSource& source, const SurveyOptions& options);

}  // namespace saca::app

#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/inputs.h"
#include "apps/saca/thinking_options.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/imitator.h"
#include "saca/lab/eval/suite.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/reflex/trigger.h"

namespace saca::app {

/// Which encounters are run, and with what.
struct SuiteCommandOptions {
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

void add_suite_options(CLI::App& command, SuiteCommandOptions& options);

/// What was run, and how it went.
struct SuiteRun {
  std::vector<std::string> methods;
  std::vector<eval::SuiteRow> rows;  ///< in the order of their numbers
  double seconds = 0.0;              ///< that this call worked, by the clock
  int worked = 0;                    ///< encounters of this call
  nlohmann::json meta;               ///< "meta.command", "meta.seed" and so on
  std::vector<std::string> notes;    ///< on where the encounters come from, in sentences
  /// Encounter `number` again.
  std::function<Result<eval::SuiteEncounter>(std::uint64_t number)> encounter_at;
  /// eval::tried_in with what the suite was run with.
  std::function<std::optional<eval::TriedScene>(const eval::SuiteEncounter&)> tried_in;
};

/// Writes an encounter as a scenario file, as the suite plays it.
/// @return  what plays it again, as a command line
[[nodiscard]] Result<std::string> write_encounter(const SuiteCommandOptions& options,
                                                  std::uint64_t number);

/// Runs it, with progress on the error stream and a journal that the same command goes on from.
/// @param command  as the user gave it, for records
/// @param methods  names of eval::methods(), in the order of tables
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<SuiteRun>> run_suite(const SuiteCommandOptions& options,
                                                        const std::string& command,
                                                        const std::vector<std::string>& methods);

/// The shipped networks of those methods that imitate.
/// @param methods  names of eval::methods()
[[nodiscard]] Result<std::shared_ptr<const eval::Imitators>> imitators_of(
    const std::vector<std::string>& methods, const Places& places);

/// nullopt: it is not among them.
[[nodiscard]] std::optional<std::size_t> index_of(const std::vector<std::string>& methods,
                                                  std::string_view method);

/// The names of a list "a,b,c"; empty: all that there are with this memory, model and these
/// weights.
/// @param danger  file of weights, or empty
/// @return  an error where a name is none, comes twice, or needs or leaves out what was not given
[[nodiscard]] Result<std::vector<std::string>> methods_from(const std::string& list,
                                                            const ThinkingOptions& thinking,
                                                            const std::string& danger);

}  // namespace saca::app

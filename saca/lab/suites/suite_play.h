#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/eval/imitator.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/suites/encounter_source.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_run.h"
#include "saca/lab/suites/suite_thinking.h"
#include "saca/runtime/planes.h"

namespace saca::suites {

/// How encounters are run. A recorded driver met the world as it was recorded: so do those who are
/// compared with it.
[[nodiscard]] eval::SuiteOptions how_of(const SuiteRequest& request,
                                        const std::vector<std::string>& methods);

/// All that encounters are played with. None of the pointers is null, but `danger`.
struct SuiteBench {
  EncounterSource source;
  std::shared_ptr<const runtime::PlanesSetup> setup;
  std::shared_ptr<const intent::Model> intent;
  std::unique_ptr<SuiteThinking> thinking;
  std::shared_ptr<const learned_danger::Network> danger;  ///< nullptr: no method needs it
  std::shared_ptr<const eval::Imitators> imitators;       ///< with those that methods need
};

/// Who asks for a suite, for its records.
struct SuiteCaller {
  std::string command;     ///< as the user gave it: "suite", "ladder"
  std::string version;     ///< of the program
  std::string built_from;  ///< version and commit
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// Plays what was asked for, with progress on the error stream and a journal that the same request
/// goes on from.
/// @param methods  names of eval::methods(), in the order of tables
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<SuiteRun>> play_suite(SuiteBench bench,
                                                         const SuiteRequest& request,
                                                         const std::vector<std::string>& methods,
                                                         const SuiteCaller& caller);

/// One encounter as a scenario file, as the suite plays it.
struct EncounterReplay {
  std::string file;     ///< where it is to lie
  std::string text;     ///< of the file
  std::string command;  ///< that plays it again
};
/// @return  an error where there is no such encounter
[[nodiscard]] Result<EncounterReplay> replay_of(const EncounterSource& source,
                                                const SuiteRequest& request, std::uint64_t number);

}  // namespace saca::suites

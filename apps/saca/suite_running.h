#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/places.h"
#include "apps/saca/thinking_options.h"
#include "saca/base/core/clock.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/suite_play.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_run.h"
#include "saca/lab/suites/suite_thinking.h"

namespace saca::app {

using suites::methods_from;
using suites::SuiteRun;

void add_suite_options(CLI::App& command, suites::SuiteRequest& options);

/// Opens models as `--llm` names them, in lockstep.
/// @param clock  outlives what is returned, and the models
[[nodiscard]] suites::SuiteThinking::OpenModel lockstep_models(const Places& places, Clock& clock);

/// This program, for records.
[[nodiscard]] suites::SuiteCaller caller_of(const std::string& command);

/// Writes an encounter as a scenario file, as the suite plays it.
/// @return  what plays it again, as a command line
[[nodiscard]] Result<std::string> write_encounter(const suites::SuiteRequest& options,
                                                  std::uint64_t number);

/// Opens all that is named and plays it, with progress on the error stream and a journal that the
/// same command goes on from.
/// @param command  as the user gave it, for records
/// @param methods  names of eval::methods(), in the order of tables
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<SuiteRun>> run_suite(const suites::SuiteRequest& options,
                                                        const std::string& command,
                                                        const std::vector<std::string>& methods);

}  // namespace saca::app

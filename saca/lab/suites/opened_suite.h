#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/installation/drawn_suite.h"
#include "saca/lab/suites/encounter_source.h"
#include "saca/lab/suites/suite_play.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_result.h"
#include "saca/lab/suites/suite_run.h"
#include "saca/lab/suites/suite_thinking.h"

namespace saca::suites {

using installation::Installation;

/// Where encounters come from, and what they are played with.
struct SuiteEncounters : EncounterSource {
  installation::Inputs inputs;
};

/// Opens what the request names.
/// @param command  that asks, for the log of the test split
[[nodiscard]] Result<SuiteEncounters> open_encounters(const Installation& here,
                                                      const SuiteRequest& request,
                                                      const std::string& command);

/// A survey's encounters as a suite without twins.
[[nodiscard]] SuiteRequest suite_of(const installation::SurveyRequest& survey);

/// Opens models as `--llm` names them, in lockstep.
/// @param clock  outlives what is returned, and the models
[[nodiscard]] SuiteThinking::OpenModel lockstep_models(const Installation& here, Clock& clock);

/// Opens all that is named and plays it, with progress on the error stream and a journal that the
/// same request goes on from.
/// @param command  as the user gave it, for records
/// @param methods  names of eval::methods(), in the order of tables
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<SuiteRun>> run_suite(const Installation& here,
                                                        const SuiteRequest& request,
                                                        const std::string& command,
                                                        const std::vector<std::string>& methods);

/// The rows into `request.output`, the page beside them.
/// @return  nullopt, else what could not be written
[[nodiscard]] std::optional<Error> write_rows_and_page(const SuiteRun& run,
                                                       const SuiteResult& result,
                                                       const SuiteRequest& request);

}  // namespace saca::suites

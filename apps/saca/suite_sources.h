#pragma once

#include <string>

#include "apps/saca/inputs.h"
#include "apps/saca/suite_running.h"
#include "saca/lab/suites/encounter_source.h"

namespace saca::app {

/// Where encounters come from, and what they are played with.
struct SuiteEncounters : suites::EncounterSource {
  Inputs inputs;  ///< until planes are made of them
};

/// Opens what the options name.
/// @param command  that asks, for the log of the test split
[[nodiscard]] Result<SuiteEncounters> open_encounters(const suites::SuiteRequest& options,
                                                      const std::string& command);

}  // namespace saca::app

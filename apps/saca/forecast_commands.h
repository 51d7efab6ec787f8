#pragma once

#include <CLI/CLI.hpp>

#include "apps/saca/inputs.h"
#include "apps/saca/suite_sources.h"
#include "saca/lab/suites/played_encounter.h"

namespace saca::app {

/// Refers to the inputs.
[[nodiscard]] suites::Perceiver perceiver_of(const Inputs& inputs);

/// Which encounters, and what is drawn in them.
void add_encounter_options(CLI::App& command, suites::SuiteRequest& from);

/// `saca forecast show`.
void add_forecast_show(CLI::App& forecast, int& exit_code);

}  // namespace saca::app

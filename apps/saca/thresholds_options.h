#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "saca/onboard/reflex/trigger.h"

namespace saca::app {

/// `--t1-s` and `--waiting-cost`: when it is acted, for studies of what these numbers are worth.
void add_thresholds_options(CLI::App& command, reflex::Thresholds& thresholds);

/// What differs from what ships, as arguments, with a blank before each; empty: nothing.
[[nodiscard]] std::string thresholds_arguments(const reflex::Thresholds& thresholds);

/// All that rows depend on, for journals.
[[nodiscard]] std::string thresholds_text(const reflex::Thresholds& thresholds);

}  // namespace saca::app

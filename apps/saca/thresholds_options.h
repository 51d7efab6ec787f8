#pragma once

#include <CLI/CLI.hpp>

#include "saca/onboard/reflex/trigger.h"

namespace saca::app {

/// `--t1-s` and `--waiting-cost`: when it is acted, for studies of what these numbers are worth.
void add_thresholds_options(CLI::App& command, reflex::Thresholds& thresholds);

}  // namespace saca::app

#pragma once

#include <string>

#include "saca/onboard/reflex/trigger.h"

namespace saca::suites {

/// What differs from what ships, as arguments, with a blank before each; empty: nothing.
[[nodiscard]] std::string thresholds_arguments(const reflex::Thresholds& thresholds);

/// All that rows depend on, for journals.
[[nodiscard]] std::string thresholds_text(const reflex::Thresholds& thresholds);

}  // namespace saca::suites

#pragma once

#include "apps/saca/regulation_running.h"

namespace saca::app {

/// `saca suite REGULATION`: runs its tests, prints what each method passes, leaves page and
/// figures.
/// @return  exit code
[[nodiscard]] int run_regulation(RegulationOptions options);

}  // namespace saca::app

#pragma once

#include "apps/saca/inputs.h"
#include "saca/core/result.h"
#include "saca/reach/danger.h"

namespace saca::app {

/// With the tables that the scenario's actors need, from `danger_place`. Those that are not there,
/// or not right for this car, are solved, seconds each, with progress on the error stream, and kept
/// there if they can be.
/// @return  an error where a car's limits are beyond what can be solved
[[nodiscard]] Result<reach::DangerModel> usual_danger(const ScenarioInputs& inputs);

}  // namespace saca::app

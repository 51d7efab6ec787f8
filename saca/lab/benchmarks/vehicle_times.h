#pragma once

#include <nlohmann/json_fwd.hpp>

#include "saca/base/core/clock.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::benchmarks {

/// vehicle.steps_per_s: integrated milliseconds per second of computing, the controller's work
/// included: a stop from 20 m/s, over and over.
/// @param num_stops  > 0
[[nodiscard]] nlohmann::json vehicle_times(const manoeuvre::Car& car, const Clock& clock,
                                           int num_stops = 100);

}  // namespace saca::benchmarks

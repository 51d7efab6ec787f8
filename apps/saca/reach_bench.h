#pragma once

#include <nlohmann/json.hpp>

#include "saca/core/clock.h"

namespace saca::app {

/// Times of the game air3D to 2.8 s: reach.air3d_s.GRID.PRECISION.threadsN [s], and the same by
/// cell and Runge-Kutta stage [ns]; reach.air3d_tube_volume.GRID.PRECISION [m^2 rad].
void bench_reach(Clock& clock, nlohmann::json& figures);

}  // namespace saca::app

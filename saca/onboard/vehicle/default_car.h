#pragma once

#include "saca/onboard/vehicle/parameters.h"

namespace saca::vehicle {

/// The default car, read from data/vehicles/: for tests and benchmarks only, which run in the
/// project's folder.
inline Vehicle default_car() {
  return read_vehicle("data/vehicles/compact_rwd_ev.toml").value();
}

/// Rolling straight along x_W, nothing commanded.
/// @param speed  [m/s]
inline VehicleState rolling(const Vehicle& car, double speed) {
  VehicleState state;
  state.v_B = {speed, 0.0};
  state.wheel_speed.fill(speed / car.wheel_radius);
  return state;
}

}  // namespace saca::vehicle

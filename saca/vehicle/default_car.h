#pragma once

#include <filesystem>

#include "saca/vehicle/parameters.h"

namespace saca::vehicle {

/// The default car, read from this source tree's data/vehicles/: for tests and benchmarks only.
inline Vehicle default_car() {
  const auto tree = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  return read_vehicle(tree / "data" / "vehicles" / "compact_rwd_ev.toml").value();
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

#pragma once

// Cars of data/vehicles/, for tests and benchmarks, which run in the project's folder.

#include <array>
#include <string>

#include "saca/lab/prepare/car_file.h"
#include "saca/lab/prepare/vehicle_file.h"

namespace saca::prepare {

constexpr std::array shipped_cars{"compact_rwd_ev", "small_fwd_car", "midsize_suv", "delivery_van"};

/// @param name  one of `shipped_cars`
inline manoeuvre::Car shipped_car(const std::string& name) {
  return read_car("data/vehicles/" + name + ".toml").value();
}

inline manoeuvre::Car default_car() {
  return shipped_car(shipped_cars[0]);
}

/// The default car without a tuning.
inline vehicle::Vehicle default_vehicle() {
  return read_vehicle("data/vehicles/compact_rwd_ev.toml").value();
}

/// Rolling straight along x_W, nothing commanded.
/// @param speed  [m/s]
inline vehicle::VehicleState rolling(const vehicle::Vehicle& car, double speed) {
  vehicle::VehicleState state;
  state.v_B = {speed, 0.0};
  state.wheel_speed.fill(speed / car.wheel_radius);
  return state;
}

}  // namespace saca::prepare

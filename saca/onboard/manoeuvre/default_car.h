#pragma once

#include <array>
#include <string>

#include "saca/onboard/manoeuvre/car.h"

namespace saca::manoeuvre {

/// A car of data/vehicles/: for tests and benchmarks only, which run in the project's folder.
/// @param name  one of `shipped_cars`
inline Car shipped_car(const std::string& name) {
  return read_car("data/vehicles/" + name + ".toml").value();
}

constexpr std::array shipped_cars{"compact_rwd_ev", "small_fwd_car", "midsize_suv", "delivery_van"};

inline Car default_car() {
  return shipped_car(shipped_cars[0]);
}

}  // namespace saca::manoeuvre

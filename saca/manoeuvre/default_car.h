#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "saca/manoeuvre/car.h"

namespace saca::manoeuvre {

/// A car of this source tree's data/vehicles/: for tests and benchmarks only.
/// @param name  one of `shipped_cars`
inline Car shipped_car(const std::string& name) {
  const auto tree = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  return read_car(tree / "data" / "vehicles" / (name + ".toml")).value();
}

constexpr std::array shipped_cars{"compact_rwd_ev", "small_fwd_car", "midsize_suv", "delivery_van"};

inline Car default_car() {
  return shipped_car(shipped_cars[0]);
}

}  // namespace saca::manoeuvre

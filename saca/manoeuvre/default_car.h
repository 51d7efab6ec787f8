#pragma once

#include <filesystem>

#include "saca/manoeuvre/car.h"

namespace saca::manoeuvre {

/// The default car, read from this source tree's data/vehicles/: for tests and benchmarks only.
inline Car default_car() {
  const auto tree = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  return read_car(tree / "data" / "vehicles" / "compact_rwd_ev.toml").value();
}

}  // namespace saca::manoeuvre

#pragma once

#include <filesystem>

#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/tuning.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// A car and the numbers with which the controllers drive it.
struct Car : vehicle::Vehicle {
  Tuning tuning;
};

/// Where the tuning of a car's file lies: beside it, "<name>.tuning.toml".
[[nodiscard]] std::filesystem::path tuning_path(const std::filesystem::path& car);

/// Reads a car's parameters and the tuning beside them.
/// @return  Error::Code::unreadable; malformed, naming file, line and key
[[nodiscard]] Result<Car> read_car(const std::filesystem::path& path);

}  // namespace saca::manoeuvre

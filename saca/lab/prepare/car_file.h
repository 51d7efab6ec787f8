#pragma once

#include <filesystem>
#include <string>

#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::prepare {

/// A car and its name.
struct NamedCar {
  std::string name;
  manoeuvre::Car car;
};

/// Where the tuning of a car's file lies: beside it, "<name>.tuning.toml".
[[nodiscard]] std::filesystem::path tuning_path(const std::filesystem::path& car);

/// Reads a car's parameters and the tuning beside them.
/// @return  Error::Code::unreadable; malformed, naming file, line and key
[[nodiscard]] Result<manoeuvre::Car> read_car(const std::filesystem::path& path);

}  // namespace saca::prepare

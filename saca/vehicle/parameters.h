#pragma once

#include <filesystem>

#include "saca/core/result.h"
#include "saca/vehicle/vehicle.h"

namespace saca::vehicle {

/// Reads a car's parameters from a TOML file such as data/vehicles/compact_rwd_ev.toml.
/// @return  Error::Code::unreadable; malformed, naming file, line and key, for a number that is
///          missing, out of range or unknown
[[nodiscard]] Result<Vehicle> read_vehicle(const std::filesystem::path& path);

}  // namespace saca::vehicle

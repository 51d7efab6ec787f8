#pragma once

#include <filesystem>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::prepare {

/// Reads a car's parameters from a TOML file such as data/vehicles/compact_rwd_ev.toml.
/// @return  Error::Code::unreadable; malformed, naming file, line and key, for a number that is
///          missing, out of range or unknown
[[nodiscard]] Result<vehicle::Vehicle> read_vehicle(const std::filesystem::path& path);

/// Likewise, from the text of such a file.
/// @param source  name for messages, usually the path
[[nodiscard]] Result<vehicle::Vehicle> parse_vehicle(std::string_view text,
                                                     std::string_view source);

}  // namespace saca::prepare

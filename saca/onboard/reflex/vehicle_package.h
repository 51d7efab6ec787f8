#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::reflex {

/// Everything about one car that the reflex plane decides by, in one file: what a vehicle carries
/// instead of texts.
struct VehiclePackage {
  std::string name;  ///< of the car, as whoever made the package called it
  manoeuvre::Car car;
  collision::HarmModel harm;
  atlas::Atlas atlas;  ///< of this car
};

constexpr std::size_t longest_package_name = 63;  ///< [bytes]

/// A package's file: docs/formats.md.
/// @param name   at most `longest_package_name` bytes, none of them 0
/// @param atlas  the bytes of an atlas' file of this car
/// @throws ContractViolation  if the name is longer, or a number of car or harm is not finite
[[nodiscard]] std::string vehicle_package_bytes(std::string_view name, const manoeuvre::Car& car,
                                                const collision::HarmModel& harm,
                                                std::string_view atlas);

/// Reads a package into memory and makes sure that it is whole, that its numbers are finite, and
/// that its atlas belongs to its car and to this program (some 50 ms). What becomes of the file
/// afterwards does not matter.
/// @return  Error::Code::unreadable, malformed (no package, another version, cut short, altered) or
///          out_of_range (an atlas of another car or program), naming the file, wanted and got
[[nodiscard]] Result<VehiclePackage> read_vehicle_package(const std::filesystem::path& path);

}  // namespace saca::reflex

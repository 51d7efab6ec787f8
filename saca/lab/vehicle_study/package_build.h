#pragma once

#include <filesystem>
#include <string>

#include "saca/base/core/result.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::vehicle_study {

/// What a vehicle's package is made of.
struct PackageParts {
  std::string car_name;
  const manoeuvre::Car* car = nullptr;
  const collision::HarmModel* harm = nullptr;
  std::filesystem::path atlas;  ///< its file
  std::string remedy;           ///< what is said behind the reason why the atlas cannot be used
};

/// The bytes of one file for a vehicle: the car's numbers, the harm model and the atlas
/// (reflex::vehicle_package_bytes).
/// @return  Error::Code::out_of_range: the name is too long; those of atlas::read_atlas
[[nodiscard]] Result<std::string> package_of(const PackageParts& parts);

}  // namespace saca::vehicle_study

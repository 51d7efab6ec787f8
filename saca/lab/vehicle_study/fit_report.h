#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "saca/lab/tune/fit_vehicle.h"

namespace saca::vehicle_study {

/// A fit of a car to its own tests, and where it stands.
struct FitResult {
  std::string car;     ///< that it began with, as it was named
  std::string output;  ///< file of the fitted car
  tune::VehicleFit fit;
};

/// The document of `saca vehicle fit --json`, schema saca.vehicle_fit/1: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const FitResult& result);

/// The same for people: two tables, of parameters and of signals. Warnings are not in it.
[[nodiscard]] std::string text_of(const FitResult& result);

}  // namespace saca::vehicle_study

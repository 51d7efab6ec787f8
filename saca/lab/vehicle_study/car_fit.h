#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/tune/fit_vehicle.h"

namespace saca::vehicle_study {

/// The car that a fit begins with, and the text of its file.
struct BaseCar {
  std::string file;
  std::string text;
  vehicle::Vehicle car;
};

/// @return  Error::Code::unreadable, malformed, naming the file
[[nodiscard]] Result<BaseCar> read_base(const std::filesystem::path& file);

/// The logs of tests of a car, in this order.
/// @return  Error::Code::unreadable, malformed, naming the file and the line
[[nodiscard]] Result<std::vector<tune::Log>> read_logs(const std::vector<std::string>& files,
                                                       const vehicle::Vehicle& car);

/// What a fit found, and the text of the fitted car's file.
struct FittedCar {
  tune::VehicleFit fit;
  std::string file;
};

/// Fits a car to its own tests (tune::fit_vehicle); the file names the logs without their folders.
/// @param grip  of the road as far as known beforehand [-]
/// @param logs  at least one
/// @return      the errors of tune::fitted_car_file
[[nodiscard]] Result<FittedCar> fit_car(const BaseCar& base, double grip,
                                        const std::vector<tune::Log>& logs);

}  // namespace saca::vehicle_study

#include "saca/lab/vehicle_study/car_fit.h"

#include <utility>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/vehicle_file.h"
#include "saca/lab/tune/fit_car_file.h"

namespace saca::vehicle_study {

namespace fs = std::filesystem;

Result<BaseCar> read_base(const fs::path& file) {
  auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  const auto car = prepare::parse_vehicle(text.value(), file.string());
  if (!car.has_value()) {
    return car.error();
  }
  return BaseCar{file.string(), std::move(text).value(), car.value()};
}

Result<std::vector<tune::Log>> read_logs(const std::vector<std::string>& files,
                                         const vehicle::Vehicle& car) {
  std::vector<tune::Log> logs;
  for (const std::string& file : files) {
    const auto csv = read_file(file);
    if (!csv.has_value()) {
      return csv.error();
    }
    auto log = tune::read_log(csv.value(), file, car);
    if (!log.has_value()) {
      return log.error();
    }
    logs.push_back(std::move(log).value());
  }
  return logs;
}

Result<FittedCar> fit_car(const BaseCar& base, double grip, const std::vector<tune::Log>& logs) {
  std::string names;
  for (const tune::Log& log : logs) {
    names += (names.empty() ? "" : ", ") + fs::path(log.name).filename().string();
  }
  tune::VehicleFit fit = tune::fit_vehicle(base.car, grip, logs);
  auto file = tune::fitted_car_file(base.text, base.file, names, fit);
  if (!file.has_value()) {
    return file.error();
  }
  return FittedCar{std::move(fit), std::move(file).value()};
}

}  // namespace saca::vehicle_study

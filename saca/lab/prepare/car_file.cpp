#include "saca/lab/prepare/car_file.h"

#include "saca/lab/prepare/tuning_file.h"
#include "saca/lab/prepare/vehicle_file.h"

namespace saca::prepare {

std::filesystem::path tuning_path(const std::filesystem::path& car) {
  return std::filesystem::path(car).replace_extension(".tuning.toml");
}

Result<manoeuvre::Car> read_car(const std::filesystem::path& path) {
  const auto parameters = read_vehicle(path);
  if (!parameters.has_value()) {
    return parameters.error();
  }
  const auto tuning = read_tuning(tuning_path(path));
  if (!tuning.has_value()) {
    Error error = tuning.error();
    if (error.code == Error::Code::unreadable) {
      error.message += " (what the controllers need to know of the car: `saca tune --car " +
                       path.string() + "` makes it)";
    }
    return error;
  }
  return manoeuvre::Car{parameters.value(), tuning.value()};
}

}  // namespace saca::prepare

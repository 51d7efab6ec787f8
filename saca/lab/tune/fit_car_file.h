#pragma once

#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/lab/tune/fit_vehicle.h"

namespace saca::tune {

/// The text of a car's file with what was fitted in place of the base's values. Each such line says
/// from which logs and how sure; all others stay as they are.
///
/// @param base    text of the file that `fit` began with
/// @param source  its name, for messages
/// @param logs    names of the logs, for the comments
/// @return        a text that `prepare::parse_vehicle` reads as fit.car; Error::Code::malformed
///                where the base does not write a fitted key as `key = value` on a line of its own
[[nodiscard]] Result<std::string> fitted_car_file(std::string_view base, std::string_view source,
                                                  std::string_view logs, const VehicleFit& fit);

}  // namespace saca::tune

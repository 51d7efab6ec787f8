#pragma once

#include <string>

#include "saca/lab/eval/forecast_fan.h"
#include "saca/lab/report/scene_svg.h"

namespace saca::forecast_study {

/// What was forecast of one road user at one instant, over what then happened.
/// @param who        "car1"
/// @param encounter  as its title calls it: "head_on 3"
[[nodiscard]] report::SceneView fan_view(const eval::ForecastFan& fan, const std::string& who,
                                         const std::string& encounter);

/// The same as an SVG.
[[nodiscard]] std::string fan_picture(const eval::ForecastFan& fan, const std::string& who,
                                      const std::string& encounter);

}  // namespace saca::forecast_study

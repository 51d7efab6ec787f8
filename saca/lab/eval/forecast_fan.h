#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/thinking/intent/motion.h"

namespace saca::eval {

/// How far ahead a fan reaches [s].
constexpr double fan_horizon = 3.0;

/// What was forecast of one road user at one instant, and what then happened.
struct ForecastFan {
  struct Way {
    double probability = 0.0;
    intent::Forecast forecast;  ///< until fan_horizon
  };
  world::Scene seen;      ///< as it was perceived
  std::size_t actor = 0;  ///< of whom it was forecast: index into seen.actors
  std::vector<Way> ways;  ///< what the forecaster draws from; their probabilities sum to 1
  world::Track ego;       ///< X_WB, as it truly was from seen.time on, until fan_horizon or the end
  std::vector<world::Track> others;  ///< likewise X_WA, one per actor of `seen`
};

/// Plays an encounter in which the ego does nothing until some instant, and 3 s beyond.
/// @param who   "car1"
/// @param time  [s]
/// @return      nobody of that name is perceived then; or what is wrong with the encounter's scenes
[[nodiscard]] Result<ForecastFan> forecast_fan(const encounter::Stage& stage, std::string_view who,
                                               double time);

}  // namespace saca::eval

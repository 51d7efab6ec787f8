#pragma once

#include <array>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/eval/forecast_score.h"
#include "saca/lab/eval/likely_places.h"
#include "saca/thinking/intent/features.h"

namespace saca::eval {

/// What a MixtureModel learns from at one look.
struct PlaceExample {
  intent::Features features{};
  double speed = 0.0;  ///< along travel_line [m/s]
  /// Where it truly will be, against travel_line from where it is perceived [m].
  std::array<Vec2, forecast_times.size()> places{};
  bool known = false;  ///< the places are, and it moves
};

/// Plays an encounter in which the ego does nothing; every vehicle, look by look at
/// intent::look_step, from when it is first perceived until it is not any more: what
/// MixturePredictor sees. Sequences in which no place is known are left out.
/// @return  as forecast_samples
[[nodiscard]] Result<std::vector<std::vector<PlaceExample>>> place_examples(
    const encounter::Stage& stage, const ForecastWindow& window = {});

}  // namespace saca::eval

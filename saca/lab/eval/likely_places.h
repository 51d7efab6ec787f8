#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "saca/base/core/vec2.h"
#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"

namespace saca::eval {

/// After which places are held against what happened [s].
constexpr std::array<double, 4> forecast_times{0.5, 1.0, 2.0, 3.0};

/// Somebody is there with this probability, but for a normal error along its course and across.
struct LikelyPlace {
  double probability = 1.0;
  Vec2 p_W;             ///< [m]
  double course = 0.0;  ///< [rad]
  world::Spread spread;
};
/// At each of forecast_times; the same way on has the same index in each.
using LikelyPlaces = std::array<std::vector<LikelyPlace>, forecast_times.size()>;

/// Straight on at the measured speed, with the error of perception and one that grows as 0.5 a t^2,
/// a = 1 m/s^2 along and across.
[[nodiscard]] LikelyPlaces going_straight(const world::Actor& actor);

/// How well a forecast of one time predicted a place. No error counts as less than 0.1 m.
struct PlaceScore {
  double nll = 0.0;         ///< negative logarithm of the density there [ln m^2]
  double miss = 0.0;        ///< to the nearest of the six likeliest [m]
  double pit_along = 0.0;   ///< probability of less far along the course, in [0, 1]
  double pit_across = 0.0;  ///< of less far to the left of it
};
/// @param places  at least one; their probabilities sum to 1
[[nodiscard]] PlaceScore score(std::span<const LikelyPlace> places, Vec2 truth);

/// Mean distance over forecast_times of the nearest of the `most` likeliest ways on [m].
[[nodiscard]] double least_mean_miss(const LikelyPlaces& places,
                                     const std::array<Vec2, forecast_times.size()>& truth,
                                     std::size_t most);

}  // namespace saca::eval

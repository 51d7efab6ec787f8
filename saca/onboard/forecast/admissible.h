#pragma once

#include <algorithm>

namespace saca::forecast {

/// Of expected harm [-]: what forecasts cannot tell apart.
constexpr double least_tolerance = 0.002;
/// Of what full braking has above the best [-].
constexpr double tolerated_share = 0.03;

/// The expected harm up to which a plan counts as the best, because forecasts cannot tell it from
/// that: the larger of `least_tolerance` and `tolerated_share` of what full braking has above the
/// best.
///
/// @param least         of all plans that can be driven [-]
/// @param full_braking  its expected harm [-]; `least`, where it cannot be driven
constexpr double admissible_harm(double least, double full_braking) {
  return least + std::max(least_tolerance, tolerated_share * (full_braking - least));
}

}  // namespace saca::forecast

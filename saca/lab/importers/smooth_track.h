#pragma once

#include <cstddef>

#include "saca/lab/scenario/scenario.h"

namespace saca::importers {

/// A recorded motion without the noise of its camera, and what that took.
struct SmoothTrack {
  scenario::Recording samples;   ///< at equal steps, with the ego's columns filled for all
  std::size_t num_filled = 0;    ///< samples that the recording lacks
  std::size_t num_outliers = 0;  ///< positions thrown away
  double rms_shift = 0.0;        ///< of the positions kept [m]
  double largest_shift = 0.0;    ///< [m]
  double hardest = 0.0;          ///< largest acceleration of the result, in any direction [m/s^2]
};

/// Fewest samples that can be smoothed.
constexpr std::size_t fewest_samples = 5;

/// @param raw   times that grow by whole steps; poses of the body's centre; speed along the
/// heading,
///              < 0 while reversing
/// @param step  [s], > 0
/// @throws ContractViolation  if there are fewer than fewest_samples
///
/// Positions farther than 1.5 m from where the median of their neighbours within 0.5 s puts them
/// are thrown away, gaps bridged by straight lines. Positions and velocities are then fitted
/// together by a parabola over +-0.7 s, x and y apart. The heading is the direction of that motion,
/// and below 1.5 m/s, where noise decides it, runs straight from the last to the next that is
/// known; a body that never moves keeps the mean of its recorded headings. Heading and speed are
/// fitted by lines over +-0.5 s.
///
/// A motion of constant jerk J is shifted by less than 0.7^3 J / 20 s^3 in velocity's direction:
/// the hardest braking is blunted over 0.7 s.
[[nodiscard]] SmoothTrack smooth_track(const scenario::Recording& raw, double step);

}  // namespace saca::importers

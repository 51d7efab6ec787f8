#pragma once

#include <vector>

#include "saca/base/core/pose.h"

namespace saca::world {

/// Where a body's origin is over time: poses at equal steps, straight in between.
struct Track {
  double start = 0.0;      ///< time of the first pose [s]
  double step = 0.01;      ///< [s], > 0
  std::vector<Pose> X_WA;  ///< at least one
};

/// How far a body may be from where it is told to be: standard deviations of its place along the
/// way that it points, and across [m].
struct Spread {
  double along_sd = 0.0;  ///< >= 0
  double across_sd = 0.0;
};

/// The spread about a track, over time: at equal steps.
struct SpreadOverTime {
  double start = 0.0;      ///< time of the first [s]
  double step = 0.05;      ///< [s], > 0
  std::vector<Spread> at;  ///< empty: nothing is said; it never shrinks
};

/// Linear in between; before the first as at the first, after the last as at the last.
/// @throws ContractViolation  if nothing is said
[[nodiscard]] Spread spread_at(const SpreadOverTime& spread, double time);

/// Time of the last pose [s].
[[nodiscard]] double end_time(const Track& track);

/// Before its start a track stands at its first pose, after its end at its last.
[[nodiscard]] Pose pose_at(const Track& track, double time);

/// Velocity of the body's origin over ground: the slope of the segment that holds `time` [m/s];
/// zero outside the track.
[[nodiscard]] Vec2 velocity_at(const Track& track, double time);

/// Turning rate of the segment that holds `time` [rad/s]; zero outside the track.
[[nodiscard]] double yaw_rate_at(const Track& track, double time);

}  // namespace saca::world

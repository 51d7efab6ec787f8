#pragma once

#include <vector>

#include "saca/core/pose.h"

namespace saca::world {

/// Where a body's origin is over time: poses at equal steps, straight in between.
struct Track {
  double start = 0.0;      ///< time of the first pose [s]
  double step = 0.01;      ///< [s], > 0
  std::vector<Pose> X_WA;  ///< at least one
};

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

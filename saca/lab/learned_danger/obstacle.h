#pragma once

#include "saca/base/core/pose.h"
#include "saca/base/world/footprint.h"

namespace saca::learned_danger {

/// A body that the ego is to miss, going on as it does now: along an arc, its acceleration constant
/// until it stands.
struct Obstacle {
  world::Footprint body;      ///< about its own centre
  Pose X_WO;                  ///< its centre; it moves along its x
  double speed = 0.0;         ///< [m/s], >= 0
  double acceleration = 0.0;  ///< along its x [m/s^2]
  double curvature = 0.0;     ///< of its way, > 0 to the left [1/m]
};

/// Where it is, and how fast, after a while. Exact: an arc has a closed form.
/// @param time  [s], >= 0
[[nodiscard]] Obstacle after(const Obstacle& obstacle, double time);

}  // namespace saca::learned_danger

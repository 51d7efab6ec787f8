#pragma once

#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"

namespace saca::intent {

/// The line that a road user moves on, and how it moves against it.
struct Line {
  world::Road road;           ///< X_WL is on the line where the road user is, x in its direction of
                              ///< travel
  bool along_lane = true;     ///< the line is that of a lane; else the arc that its velocity and
                              ///< turning rate describe; a pedestrian's is straight
  double speed = 0.0;         ///< [m/s]
  double lateral = 0.0;       ///< speed to the left of the lane [m/s]; 0 off the lanes
  double deceleration = 0.0;  ///< along its course [m/s^2]; negative: it speeds up
  double crab = 0.0;          ///< its heading against the line [rad]
  double offset = 0.0;        ///< to the left of the nearest lane's centre [m]; 0 off the lanes
};

/// Below this, a road user is at rest: its course says nothing [m/s].
constexpr double rest_speed = 0.1;

/// @throws ContractViolation  if the actor is slower than `rest_speed`
[[nodiscard]] Line line_of(const world::Scene& scene, const world::Actor& actor);

}  // namespace saca::intent

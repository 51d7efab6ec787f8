#pragma once

#include <string>

#include "saca/manoeuvre/plan.h"
#include "saca/world/scene.h"

namespace saca::reach {

/// How dangerous an actor is to the ego, considering what the ego can still do.
struct ObstacleRisk {
  double risk = 0.0;         ///< in [0, 1]; 0 no threat, 1 braking and swerving both come too late
  double room_needed = 0.0;  ///< by the better of braking and swerving [m]
  double room_there = 0.0;   ///< on the ego's path up to the actor [m]
  std::string text;          ///< the same in one line
};

/// Room needed by the best of braking and swerving over room there, in [0, 1].
[[nodiscard]] ObstacleRisk obstacle_risk(const world::Scene& scene, const world::Actor& actor);

}  // namespace saca::reach

#pragma once

#include <string>

#include "saca/base/world/scene.h"
#include "saca/thinking/danger/danger.h"

namespace saca::danger {

/// V_h between which the risk rises from 0 to 1: the sensitivity parameters of eq. 4.
struct RiskScale {
  double lowest = -30.0;  ///< V_h^min [m]
  double highest = 0.0;   ///< V_h^max [m]
};

/// Vehicles and obstacles: from a miss by 30 m, the authors' own number, to a touch. People outside
/// vehicles: to a miss by 1 m, which is no longer a miss for somebody who may take a step.
[[nodiscard]] RiskScale risk_scale(world::ActorKind kind);

/// How dangerous an actor is to the ego, in view of what the ego can still do.
struct ObstacleRisk {
  double risk = 0.0;     ///< R(x) of eq. 4, in [0, 1]
  double value = -30.0;  ///< V_h [m]: depth of the best evasion's contact; < 0: its room
  bool exact = true;     ///< as in `Danger`, and both move as the problem says
  bool judged = true;  ///< false: behind the ego, where braking and swerving would be wrong; 0 then
};

/// V_h of the actor as an obstacle that keeps its velocity, and the risk that follows (eq. 4).
///
/// The problem knows neither the road's edges nor other actors nor that the actor may brake or
/// turn: those are what `intent` and the rollouts are for. An actor that slides aside by more than
/// 0.5 m/s moves along its velocity for the problem, its body being that of a disc around it, and
/// an ego whose sideslip exceeds 0.1 rad likewise; the answer is then conservative, not exact. Who
/// is behind the ego is not judged (docs/decisions/0005).
[[nodiscard]] ObstacleRisk obstacle_risk(const world::Scene& scene, const world::Actor& actor,
                                         const DangerModel& model);

/// What the problem does not know of both, and what was learnt does.
[[nodiscard]] Motion motion_of(const world::Scene& scene, const world::Actor& actor);
/// The meeting of ego and actor, by the frame of `avoidance.h`.
[[nodiscard]] Meeting meeting_of(const world::Scene& scene, const world::Actor& actor);
/// The obstacle's frame in the world: where its x points, there it moves.
[[nodiscard]] Pose obstacle_frame(const world::Actor& actor);

/// The same in one line: "best evasion misses by 1.2 m", "best evasion still hits 0.4 m deep".
[[nodiscard]] std::string explanation(const ObstacleRisk& risk);

}  // namespace saca::danger

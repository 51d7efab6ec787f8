#pragma once

#include <optional>
#include <string>

#include "saca/world/scene.h"

namespace saca::reach {

/// How dangerous an actor is to the ego, in view of what the ego can still do.
struct ObstacleRisk {
  double risk = 0.0;  ///< in [0, 1]; 0 no conflict, 1 braking and swerving both come too late
  std::optional<double>
      room_needed;          ///< by the better of braking and swerving [m]; nullopt: no conflict
  double room_there = 0.0;  ///< from the ego to the actor along the ego's path [m]
  bool swerve_is_better = false;  ///< of the two
};

/// Room needed by the best of braking and swerving over the room there, at most 1.
///
/// Braking: the way that the ego takes until it is at rest (or as slow as an actor that drives on)
/// beyond that of the actor, at grip x g after 0.10 s. Swerving: the way until the footprints are
/// clear of each other to the side where the road is wide enough, at 0.8 x grip x g after 0.12 s.
/// Both delays reproduce the reference manoeuvres in docs/architecture.md. A conflict is looked for
/// over 10 s, with 0.5 s tolerance for crossing traffic.
[[nodiscard]] ObstacleRisk obstacle_risk(const world::Scene& scene, const world::Actor& actor);

/// The same in one line, e.g. "braking needs 18.2 m of the 25.0 m that are there".
[[nodiscard]] std::string explanation(const ObstacleRisk& risk);

}  // namespace saca::reach

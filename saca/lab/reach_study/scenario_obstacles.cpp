#include "saca/lab/reach_study/scenario_obstacles.h"

#include <variant>

#include "saca/lab/sim/traffic.h"

namespace saca::reach_study {

std::vector<danger::ObstacleKind> obstacles_of(const scenario::Scenario& scenario,
                                               const world::Footprint& ego) {
  std::vector<danger::ObstacleKind> found;
  const auto note = [&](const world::Actor& actor) {
    found.push_back({actor.footprint, norm(actor.v_W)});
  };
  const Pose X_WB =
      std::holds_alternative<scenario::EgoStart>(scenario.ego)
          ? world::from_lane(scenario.road, std::get<scenario::EgoStart>(scenario.ego).pose)
          : std::get<scenario::Recording>(scenario.ego).front().X_WA;
  sim::Traffic traffic(scenario);
  for (int k = 0; traffic.time() <= scenario.duration; ++k) {
    if (k % 10 == 0) {
      for (const world::Actor& actor : traffic.actors()) {
        note(actor);
      }
      for (const world::Actor& ghost : traffic.ghosts()) {
        note(ghost);
      }
    }
    traffic.advance(X_WB, {}, ego);
  }
  return found;
}

}  // namespace saca::reach_study

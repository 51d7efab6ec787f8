#include "saca/lab/importers/traffic_road.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/scenario/rounding.h"

namespace saca::importers {
namespace {

constexpr double beside_wheels = 0.2;  // of road beyond a recorded body [m]

/// A scenario's road and the stretch of it that counts.
struct Stretch {
  const world::Road& road;
  double behind;
  double ahead;
};

/// Moves the edges out to where a body reaches, if its centre is on the stretch.
void widen(const Stretch& stretch, const world::Footprint& body, const Pose& X_WA,
           world::Road& road) {
  const world::LanePose at = to_lane(stretch.road, X_WA);
  if (at.s < -stretch.behind || at.s > stretch.ahead || at.d > stretch.road.left_edge ||
      at.d < stretch.road.right_edge) {
    return;
  }
  const double reach = 0.5 * (body.width * std::abs(std::cos(at.heading)) +
                              body.length * std::abs(std::sin(at.heading)));
  road.left_edge = std::max(road.left_edge, scenario::rounded_mm(at.d + reach + beside_wheels));
  road.right_edge = std::min(road.right_edge, scenario::rounded_mm(at.d - reach - beside_wheels));
}

}  // namespace

world::Road moved_road(const world::Road& road, Vec2 way_W) {
  world::Road moved = road;
  moved.X_WL = scenario::rounded_pose({road.X_WL.p + way_W, road.X_WL.yaw});
  moved.curvature = scenario::rounded(road.curvature, 1e6);
  moved.lane_width = scenario::rounded_mm(road.lane_width);
  moved.left_edge = scenario::rounded_mm(road.left_edge);
  moved.right_edge = scenario::rounded_mm(road.right_edge);
  return moved;
}

world::Road widened_road(const scenario::Scenario& scenario, double behind, double ahead) {
  const Stretch stretch{scenario.road, behind, ahead};
  world::Road road = scenario.road;
  for (const scenario::ScenarioActor& actor : scenario.actors) {
    const auto* recording = std::get_if<scenario::Recording>(&actor.motion);
    expects(recording != nullptr, "every actor has a recording");
    if (actor.kind == world::ActorKind::obstacle || actor.kind == world::ActorKind::pedestrian) {
      continue;
    }
    for (const scenario::Sample& sample : *recording) {
      widen(stretch, actor.footprint, sample.X_WA, road);
    }
  }
  const Pose X_BA{{scenario::standard_ego.centre_x, 0.0}, 0.0};  // the body's centre
  widen(stretch, scenario::standard_ego, scenario::ego_at(scenario, 0.0).X_WB * X_BA, road);
  if (const auto* ego = std::get_if<scenario::Recording>(&scenario.ego)) {
    for (const scenario::Sample& sample : *ego) {
      widen(stretch, scenario::standard_ego, sample.X_WA * X_BA, road);
    }
  }
  return road;
}

}  // namespace saca::importers

#include "saca/lab/encounter/state_json.h"

#include <cmath>

#include "saca/base/core/units.h"

namespace saca::encounter {

using nlohmann::json;

json road_json(const world::Road& road) {
  return {{"topology", name(road.topology)},
          {"x_m", road.X_WL.p.x},
          {"y_m", road.X_WL.p.y},
          {"heading_deg", to_degrees(road.X_WL.yaw)},
          {"curvature_1pm", road.curvature},
          {"lane_width_m", road.lane_width},
          {"left_edge_m", road.left_edge},
          {"right_edge_m", road.right_edge},
          {"left_beyond", name(road.left_beyond)},
          {"right_beyond", name(road.right_beyond)},
          {"oncoming_left", road.oncoming_left},
          {"oncoming_right", road.oncoming_right}};
}

json ego_json(const world::EgoState& ego, double steering) {
  const double speed = norm(ego.v_B);
  constexpr double slow = 0.5;  // below, a sideslip angle says nothing
  return {{"x_m", ego.X_WB.p.x},
          {"y_m", ego.X_WB.p.y},
          {"heading_deg", to_degrees(ego.X_WB.yaw)},
          {"speed_mps", speed},
          {"sideslip_deg", speed > slow ? to_degrees(std::atan2(ego.v_B.y, ego.v_B.x)) : 0.0},
          {"yaw_rate_degps", to_degrees(ego.yaw_rate)},
          {"steering_deg", to_degrees(steering)}};
}

json actor_json(const world::Actor& actor) {
  return {{"id", actor_name(actor)},
          {"x_m", actor.X_WA.p.x},
          {"y_m", actor.X_WA.p.y},
          {"heading_deg", to_degrees(actor.X_WA.yaw)},
          {"speed_mps", norm(actor.v_W)}};
}

json actor_bodies_json(const scenario::Scenario& scenario) {
  json actors = json::array();
  for (const scenario::ScenarioActor& actor : scenario.actors) {
    actors.push_back({{"id", actor_name(actor)},
                      {"kind", name(actor.kind)},
                      {"shape", name(actor.footprint.shape)},
                      {"length_m", actor.footprint.length},
                      {"width_m", actor.footprint.width}});
  }
  return actors;
}

}  // namespace saca::encounter

#include "saca/lab/learned_danger/perceived.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "saca/base/core/static_vector.h"
#include "saca/lab/learned_danger/acting.h"
#include "saca/thinking/danger/risk.h"

namespace saca::learned_danger {

Ego perceived_ego(const manoeuvre::Car& car, const world::EgoState& ego) {
  constexpr double steers_from = 1.0;  // [m/s]
  const double speed = norm(ego.v_B);
  const double curvature = speed > steers_from ? ego.yaw_rate / speed : 0.0;
  return {
      .X_WB = ego.X_WB,
      .v_B = ego.v_B,
      .yaw_rate = ego.yaw_rate,
      .a_B = ego.a_B,
      .steering = std::clamp(std::atan((car.cg_to_front_axle + car.cg_to_rear_axle) * curvature),
                             -car.steering_limit, car.steering_limit),
      .braking = std::max(0.0, -ego.a_B.x),
      .driving = std::max(0.0, ego.a_B.x)};
}

Obstacle perceived_obstacle(const danger::Meeting& meeting, const danger::Motion& motion,
                            const Pose& X_WO) {
  world::Footprint box = meeting.obstacle;
  box.shape = world::Shape::box;
  box.centre_x = 0.0;
  return {.body = box,
          .X_WO = X_WO,
          .speed = meeting.obstacle_speed,
          .acceleration = motion.obstacle_acceleration,
          .curvature = motion.obstacle_curvature};
}

State most_dangerous(const Network& network, const manoeuvre::Car& car, const world::Scene& scene) {
  State state{.ego = perceived_ego(car, scene.ego), .grip = scene.grip, .obstacles = {}};
  struct Candidate {
    double v = 0.0;
    double distance = 0.0;
    Obstacle obstacle;
  };
  StaticVector<Candidate, world::max_actors> all;
  for (const world::Actor& actor : scene.actors) {
    State alone = state;
    alone.obstacles.push_back(perceived_obstacle(danger::meeting_of(scene, actor),
                                                 danger::motion_of(scene, actor),
                                                 danger::obstacle_frame(actor)));
    all.push_back({highest_single_v(network, scene.ego_footprint, alone),
                   norm(actor.X_WA.p - scene.ego.X_WB.p), alone.obstacles[0]});
  }
  const auto key = [](const Candidate& one) { return std::pair(-one.v, one.distance); };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Candidate& a, const Candidate& b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < std::min(all.size(), most_obstacles); ++i) {
    state.obstacles.push_back(all[i].obstacle);
  }
  return state;
}

}  // namespace saca::learned_danger

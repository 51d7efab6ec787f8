#include "saca/reach/risk.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/world/time_to_conflict.h"

namespace saca::reach {
namespace {

using world::Actor;
using world::LanePose;
using world::Scene;

constexpr double gravity = 9.81;            // [m/s^2]
constexpr double braking_delay = 0.10;      // [s], see the header
constexpr double swerve_delay = 0.12;       // [s], likewise
constexpr double swerve_share = 0.8;        // of the grip, likewise
constexpr double look_ahead = 10.0;         // [s]
constexpr double crossing_tolerance = 0.5;  // [s]
constexpr double never = std::numeric_limits<double>::infinity();

/// The actor along the ego's lane.
struct Along {
  double speed;         ///< [m/s], > 0 with the ego's direction
  double deceleration;  ///< [m/s^2], >= 0
};

Along along_lane(const Scene& scene, const Actor& actor) {
  const double lane_course = actor.X_WA.yaw - world::to_lane(scene.road, actor.X_WA).heading;
  const Vec2 v_L = rotated(actor.v_W, -lane_course);
  const Vec2 a_L = rotated(actor.a_W, -lane_course);
  return {v_L.x, v_L.x > 0.0 ? std::max(0.0, -a_L.x) : 0.0};
}

double room_to_brake(double speed, double grip, const Along& actor) {
  const double braking = grip * gravity;
  const double way = speed * speed / (2.0 * braking) + speed * braking_delay;
  const double onto = std::max(0.0, speed - actor.speed);
  const double while_it_drives = onto * onto / (2.0 * braking) + onto * braking_delay;
  if (actor.speed <= 0.0 || actor.deceleration <= 0.0) {
    return while_it_drives;  // oncoming speed counts in full: what is not shed by the ego remains
  }
  return std::max(while_it_drives, way - actor.speed * actor.speed / (2.0 * actor.deceleration));
}

/// @param X_WA  where the actor is when they meet: who crosses fills the lane only then
double room_to_swerve(const Scene& scene, const Actor& actor, const Pose& X_WA, double closing,
                      double actor_deceleration) {
  const LanePose ego = world::to_lane(scene.road, scene.ego.X_WB);
  const Pose X_WL = world::from_lane(scene.road, {.s = world::to_lane(scene.road, X_WA).s});
  const Vec2 to_left = rotated({0.0, 1.0}, X_WL.yaw);
  const auto d_of = [&](Vec2 p_W) { return world::to_lane(scene.road, {p_W, 0.0}).d; };
  const double actor_left = d_of(world::support(actor.footprint, X_WA, to_left));
  const double actor_right = d_of(world::support(actor.footprint, X_WA, -to_left));
  const double half = 0.5 * scene.ego_footprint.width;

  double way = never;  // to the side, the shorter of the two that the road has
  if (actor_left + 2.0 * half <= scene.road.left_edge) {
    way = std::min(way, std::max(0.0, actor_left + half - ego.d));
  }
  if (actor_right - 2.0 * half >= scene.road.right_edge) {
    way = std::min(way, std::max(0.0, ego.d - (actor_right - half)));
  }
  const double sideways = swerve_share * scene.grip * gravity;
  if (way == never) {
    return never;
  }
  const double t = std::sqrt(2.0 * way / sideways) + swerve_delay;
  return closing * t + 0.5 * actor_deceleration * t * t;
}

}  // namespace

ObstacleRisk obstacle_risk(const Scene& scene, const Actor& actor) {
  if (world::is_behind(scene, actor)) {
    return {};
  }
  const auto conflict = world::time_to_conflict(scene, actor, look_ahead, crossing_tolerance);
  if (!conflict) {
    return {};
  }
  const double speed = norm(scene.ego.v_B);
  const Along along = along_lane(scene, actor);
  // The room now: what the ego drives until the conflict less what the actor drives ahead of it.
  const double t = *conflict;
  const double moving =
      along.deceleration > 0.0 ? std::min(t, along.speed / along.deceleration) : t;
  const double ahead = (along.speed - 0.5 * along.deceleration * moving) * moving;
  const double room = std::max(0.0, speed * t - ahead);

  const double brake = room_to_brake(speed, scene.grip, along);
  const double swerve = room_to_swerve(scene, actor, world::actor_going_on(actor, t),
                                       std::max(0.0, speed - along.speed), along.deceleration);
  const double needed = std::min(brake, swerve);
  const double risk = room > 0.0 ? std::clamp(needed / room, 0.0, 1.0) : 1.0;
  return {
      .risk = risk, .room_needed = needed, .room_there = room, .swerve_is_better = swerve < brake};
}

std::string explanation(const ObstacleRisk& risk) {
  if (!risk.room_needed) {
    return "no conflict within 10 s if both go on";
  }
  return fmt::format("{} needs {:.1f} m of the {:.1f} m that are there",
                     risk.swerve_is_better ? "swerving" : "braking", *risk.room_needed,
                     risk.room_there);
}

}  // namespace saca::reach

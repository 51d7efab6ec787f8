#include "saca/thinking/intent/observed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::LanePose;
using world::Road;
using world::Scene;

constexpr double known_course = 0.5;  // [m/s]: slower, the body's heading tells the direction

/// A body along the road, in the direction in which it travels.
struct AlongRoad {
  LanePose place;      ///< of its origin
  double direction;    ///< 1 along the lanes, -1 against them
  double speed;        ///< along the lanes [m/s], < 0 against
  double front, rear;  ///< s of its ends [m]
};

AlongRoad along_road(const Road& road, const Pose& X_WA, Vec2 v_W,
                     const world::Footprint& footprint) {
  const LanePose place = world::to_lane(road, X_WA);
  const double lane_yaw = wrap_angle(X_WA.yaw - place.heading);
  const double speed = rotated(v_W, -lane_yaw).x;
  const double facing = std::cos(place.heading);
  const double direction = (std::abs(speed) > known_course ? speed : facing) < 0.0 ? -1.0 : 1.0;
  const double half = world::half_axes(footprint).x;
  const double centre = place.s + facing * footprint.centre_x;
  return {place, direction, speed, centre + half, centre - half};
}

double lane_number(const Road& road, double d) {
  return std::round(d / road.lane_width);
}

/// What is ahead of `own` gets nearer, if this is.
void look_ahead(const Road& road, const AlongRoad& own, const AlongRoad& other, Observation& seen) {
  if (lane_number(road, other.place.d) != lane_number(road, own.place.d) ||
      own.direction * (other.place.s - own.place.s) <= 0.0) {
    return;
  }
  const double gap =
      std::max(0.0, own.direction > 0.0 ? other.rear - own.front : own.rear - other.front);
  if (gap < std::min(seen.gap, farthest_ahead)) {
    seen.gap = gap;
    seen.gap_speed = own.direction * (other.speed - own.speed);
  }
}

bool is_on_road(const Road& road, double d) {
  return d < road.left_edge && d > road.right_edge;
}

}  // namespace

Observation observed(const Scene& scene, std::size_t actor) {
  expects(actor < scene.actors.size(), "an actor of the scene");
  const Actor& own_actor = scene.actors[actor];
  const double speed = norm(own_actor.v_W);
  Observation seen{.speed = speed, .acceleration = 0.0, .yaw_rate = own_actor.yaw_rate};
  if (speed > 0.0) {
    seen.acceleration = dot(own_actor.a_W, own_actor.v_W) / speed;
  }
  seen.steering = own_actor.shared.steering.value_or(not_known);
  seen.throttle = own_actor.shared.throttle.value_or(not_known);
  seen.brake = own_actor.shared.brake.value_or(not_known);
  const Road& road = scene.road;
  const AlongRoad own = along_road(road, own_actor.X_WA, own_actor.v_W, own_actor.footprint);
  if (world::is_crossing(scene, own_actor) || !is_on_road(road, own.place.d)) {
    return seen;
  }
  const double width = road.lane_width;
  const double lane_yaw = wrap_angle(own_actor.X_WA.yaw - own.place.heading);
  seen.lane_width = width;
  seen.offset = own.direction * (own.place.d - width * lane_number(road, own.place.d));
  seen.lateral_speed = own.direction * rotated(own_actor.v_W, -lane_yaw).y;
  seen.heading =
      own.direction > 0.0 ? own.place.heading : wrap_angle(own.place.heading + std::numbers::pi);
  seen.gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const Actor& other = scene.actors[i];
    if (i != actor && !world::is_crossing(scene, other)) {
      look_ahead(road, own, along_road(road, other.X_WA, other.v_W, other.footprint), seen);
    }
  }
  look_ahead(road, own,
             along_road(road, scene.ego.X_WB, rotated(scene.ego.v_B, scene.ego.X_WB.yaw),
                        scene.ego_footprint),
             seen);
  return seen;
}

}  // namespace saca::intent

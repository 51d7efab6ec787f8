#include "saca/lab/eval/lane_view.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/vec2.h"

namespace saca::eval {
namespace {

/// Half of a box along and across the lane.
Vec2 half_extent(const world::Footprint& body, double heading) {
  const double length = 0.5 * body.length;
  const double width = 0.5 * body.width;
  const double c = std::abs(std::cos(heading));
  const double s = std::abs(std::sin(heading));
  return {c * length + s * width, s * length + c * width};
}

}  // namespace

LaneView lane_view(const world::Scene& scene, const world::Actor& actor) {
  const world::LanePose ego =
      world::to_lane(scene.road, scene.ego.X_WB * Pose{{scene.ego_footprint.centre_x, 0.0}, 0.0});
  const world::LanePose other = world::to_lane(scene.road, actor.X_WA);
  const Vec2 ego_half = half_extent(scene.ego_footprint, ego.heading);
  const Vec2 half = half_extent(actor.footprint, other.heading);
  // The lane's direction where each is.
  const Vec2 ego_v_L = rotated(scene.ego.v_B, ego.heading);
  const Vec2 v_L = rotated(actor.v_W, other.heading - actor.X_WA.yaw);
  const double towards = other.d > ego.d ? 1.0 : -1.0;
  return {.gap = std::abs(other.s - ego.s) - ego_half.x - half.x,
          .side_gap = std::abs(other.d - ego.d) - ego_half.y - half.y,
          .speed = v_L.x,
          .closing_aside = -towards * v_L.y,
          .ego_speed = ego_v_L.x,
          .ego_aside = towards * ego_v_L.y,
          .ahead = other.s > ego.s,
          .left = other.d > ego.d};
}

std::optional<double> time_to_collision(const LaneView& view) {
  const double closing = view.ego_speed - view.speed;
  if (!view.ahead || view.side_gap > 0.0 || closing <= 0.0) {
    return std::nullopt;
  }
  return std::max(0.0, view.gap) / closing;
}

}  // namespace saca::eval

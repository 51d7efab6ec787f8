#include "saca/thinking/intent/line.h"

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"

namespace saca::intent {

Line line_of(const world::Scene& scene, const world::Actor& actor) {
  const double speed = norm(actor.v_W);
  expects(speed >= rest_speed, "the actor moves");
  const double course = std::atan2(actor.v_W.y, actor.v_W.x);
  Line line{
      .road = scene.road,
      .along_lane = actor.kind != world::ActorKind::pedestrian && !world::is_crossing(scene, actor),
      .speed = speed,
      .deceleration = -dot(actor.a_W, actor.v_W) / speed};
  if (!line.along_lane) {
    line.road.X_WL = {actor.X_WA.p, course};
    line.road.curvature = actor.kind == world::ActorKind::pedestrian ? 0.0 : actor.yaw_rate / speed;
    line.crab = wrap_angle(actor.X_WA.yaw - course);
    return line;
  }
  const world::LanePose at = world::to_lane(scene.road, actor.X_WA);
  const Pose X_WL = world::from_lane(scene.road, {.s = at.s, .d = at.d});
  const double width = scene.road.lane_width;
  const bool oncoming = std::cos(course - X_WL.yaw) < 0.0;
  line.road.curvature = scene.road.curvature / (1.0 - scene.road.curvature * at.d);
  line.road.X_WL = X_WL;
  line.offset = at.d - width * std::round(at.d / width);
  if (oncoming) {
    line.road.X_WL.yaw = wrap_angle(X_WL.yaw + std::numbers::pi);
    line.road.curvature = -line.road.curvature;
    line.offset = -line.offset;
  }
  line.lateral = rotated(actor.v_W, -line.road.X_WL.yaw).y;
  return line;
}

}  // namespace saca::intent

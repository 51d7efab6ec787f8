#include "saca/thinking/danger/risk.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/world/time_to_conflict.h"

namespace saca::danger {
namespace {

using world::Actor;
using world::ActorKind;

constexpr double still = 0.5;  // [m/s]: slower than that is noise of perception, not motion

/// Along and across the body's axis.
Vec2 velocity_in_body(const Actor& actor) {
  return rotated(actor.v_W, -actor.X_WA.yaw);
}

bool slides(const Actor& actor) {
  return std::abs(velocity_in_body(actor).y) > still;
}

bool is_round(const world::Footprint& footprint) {
  return footprint.shape == world::Shape::ellipse && footprint.length == footprint.width;
}

/// The disc about its origin that holds a body however it is turned.
world::Footprint disc_around(const world::Footprint& body) {
  const double diameter = 2.0 * world::bounding_radius(body);
  return {.shape = world::Shape::ellipse, .length = diameter, .width = diameter};
}

/// What stands for the actor in its frame, about its own centre: itself, or the disc around it
/// where it slides.
world::Footprint body_of(const Actor& actor) {
  if (!slides(actor) || is_round(actor.footprint)) {
    return actor.footprint;
  }
  world::Footprint centred = actor.footprint;
  centred.centre_x = 0.0;
  return disc_around(centred);
}

/// Of the ego [rad]. At a crawl the course is the heading, whatever the noise of v says.
double sideslip_of(const world::EgoState& ego) {
  return norm(ego.v_B) > still ? std::atan2(ego.v_B.y, ego.v_B.x) : 0.0;
}

/// The problem's body axis is the course; beyond this a car is not where the problem has it.
bool drifts(const world::EgoState& ego) {
  constexpr double most = 0.1;  // [rad]: moves the ends of a car by 0.25 m
  return std::abs(sideslip_of(ego)) > most;
}

/// The disc around its centre of mass, where it drifts.
world::Footprint body_of(const world::Scene& scene) {
  return drifts(scene.ego) ? disc_around(scene.ego_footprint) : scene.ego_footprint;
}

}  // namespace

RiskScale risk_scale(ActorKind kind) {
  const bool person =
      kind == ActorKind::pedestrian || kind == ActorKind::bicycle || kind == ActorKind::motorcycle;
  return person ? RiskScale{.lowest = -30.0, .highest = -1.0} : RiskScale{};
}

Pose obstacle_frame(const Actor& actor) {
  const Vec2 centre_W = actor.X_WA * Vec2{actor.footprint.centre_x, 0.0};
  if (slides(actor)) {
    return {centre_W, std::atan2(actor.v_W.y, actor.v_W.x)};
  }
  const bool backwards = velocity_in_body(actor).x < -still;
  return {centre_W, actor.X_WA.yaw + (backwards ? std::numbers::pi : 0.0)};
}

Meeting meeting_of(const world::Scene& scene, const Actor& actor) {
  const Pose X_WO = obstacle_frame(actor);
  const Vec2 p_O = inverse(X_WO) * scene.ego.X_WB.p;
  const double speed = norm(actor.v_W);
  const double course = scene.ego.X_WB.yaw + sideslip_of(scene.ego);
  return {.ego = body_of(scene),
          .obstacle = body_of(actor),
          .grip = scene.grip,
          .obstacle_speed = speed > still ? speed : 0.0,
          .state = {p_O.x, p_O.y, wrap_angle(course - X_WO.yaw), norm(scene.ego.v_B)}};
}

Motion motion_of(const world::Scene& scene, const Actor& actor) {
  constexpr double turns_from = 1.0;  // [m/s]: at a crawl a yaw rate is no curvature
  const double speed = norm(actor.v_W);
  const Vec2 ahead = rotated(Vec2{1.0, 0.0}, obstacle_frame(actor).yaw);
  return {.sideslip = sideslip_of(scene.ego),
          .yaw_rate = scene.ego.yaw_rate,
          .a_B = scene.ego.a_B,
          .obstacle_acceleration = speed > still ? dot(actor.a_W, ahead) : 0.0,
          .obstacle_curvature = speed > turns_from ? actor.yaw_rate / speed : 0.0};
}

ObstacleRisk obstacle_risk(const world::Scene& scene, const Actor& actor,
                           const DangerModel& model) {
  if (world::is_behind(scene, actor)) {
    return {.risk = 0.0, .value = 0.0, .exact = false, .judged = false};
  }
  const Danger danger = model.danger(meeting_of(scene, actor), motion_of(scene, actor));
  const RiskScale scale = risk_scale(actor.kind);
  const double share = (danger.value - scale.lowest) / (scale.highest - scale.lowest);
  return {.risk = std::clamp(share, 0.0, 1.0),
          .value = danger.value,
          .exact = danger.exact && !slides(actor) && !drifts(scene.ego),
          .judged = true};
}

std::string explanation(const ObstacleRisk& risk) {
  if (!risk.judged) {
    return "behind the ego: not judged";
  }
  const char* const about = risk.exact ? "" : risk.value >= 0.0 ? "at most " : "at least ";
  if (risk.value >= 0.0) {
    return fmt::format("best evasion still hits {}{:.1f} m deep", about, risk.value);
  }
  return fmt::format("best evasion misses by {}{:.1f} m", about, -risk.value);
}

}  // namespace saca::danger

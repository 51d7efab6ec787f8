#include "saca/onboard/reflex/intake.h"

#include <algorithm>
#include <cmath>

#include "saca/base/world/time_to_conflict.h"

namespace saca::reflex {
namespace {

using world::Actor;
using world::EgoState;
using world::Scene;

constexpr double unknown_acceleration = 3.0;  // [m/s^2], assumption: of who is not seen

bool is_same(const Actor& a, const Actor& b) {
  return a.kind == b.kind && a.id == b.id;
}

const Actor* find(const Scene& scene, const Actor& actor) {
  const auto* const found = std::find_if(scene.actors.begin(), scene.actors.end(),
                                         [&](const Actor& other) { return is_same(other, actor); });
  return found == scene.actors.end() ? nullptr : found;
}

/// As it moves now, `dt` seconds later.
Actor moved_on(Actor actor, double dt) {
  const double speed = norm(actor.v_W);
  const Pose X = world::actor_going_on(actor, dt);
  const Pose soon = world::actor_going_on(actor, dt + 0.01);
  actor.v_W = speed > 0.0 ? 100.0 * (soon.p - X.p) : actor.v_W;
  actor.X_WA = X;
  actor.position_sd =
      std::hypot(actor.position_sd, actor.velocity_sd * dt, 0.5 * unknown_acceleration * dt * dt);
  actor.velocity_sd = std::hypot(actor.velocity_sd, unknown_acceleration * dt);
  actor.age += dt;
  return actor;
}

/// As it moves now, forwards or backwards: on the arc of its turning rate, with its acceleration,
/// until rest.
EgoState moved_on(EgoState ego, double dt) {
  const double v = ego.v_B.x;
  const double a = ego.a_B.x;
  const bool slows = v < 0.0 ? a > 0.0 : a < 0.0;
  const bool rests = slows && -v / a <= dt;
  const double moving = rests ? -v / a : dt;
  const double turned = ego.yaw_rate * moving;
  ego.X_WB.p = ego.X_WB.p + rotated({(v + 0.5 * a * moving) * moving, ego.v_B.y * moving},
                                    ego.X_WB.yaw + 0.5 * turned);
  ego.X_WB.yaw = wrap_angle(ego.X_WB.yaw + turned);
  ego.v_B = rests ? Vec2{} : Vec2{v + a * moving, ego.v_B.y};
  ego.yaw_rate = rests ? 0.0 : ego.yaw_rate;
  return ego;
}

/// The road, but from a point beside the ego on where that is far round a bend: s begins anew half
/// a turn from X_WL, and who is ahead there would be behind.
world::Road beside_ego(const Scene& scene) {
  constexpr double far_round = 1.0;  // [rad]
  world::Road road = scene.road;
  const double s = world::to_lane(road, scene.ego.X_WB).s;
  if (std::abs(road.curvature * s) > far_round) {
    road.X_WL = world::from_lane(road, {s, 0.0, 0.0});
  }
  return road;
}

/// A scene without its road users, at time 0: whether perception's frame breaks a rule does not
/// depend on them, nor on the clock.
Scene frame_of(const Scene& scene) {
  Scene frame = scene;
  frame.time = 0.0;
  frame.actors.clear();
  return frame;
}

}  // namespace

IntakeResult Intake::take(const Scene& scene) noexcept {
  Scene frame = frame_of(scene);
  const bool has_time = std::abs(scene.time) <= latest;
  if (!has_time || world::broken_rule(frame)) {
    const double time = has_time ? scene.time - began_ : delivered_;
    const bool is_late = time < delivered_ && time >= delivered_ - longest_gap;
    return carry_on_to(is_late ? delivered_ : time);
  }
  frame.road = beside_ego(frame);
  IntakeResult taken{.usable = true};
  frame.time = scene.time - began_;
  taken.new_drive =
      !seen_at_ || std::abs(frame.time - delivered_) > longest_gap || frame.time > longest_drive;
  if (taken.new_drive) {
    began_ = scene.time;
    frame.time = 0.0;
  } else if (frame.time < delivered_ && frame.time <= *seen_at_) {
    return {.usable = false, .degraded = true};
  }
  const Scene before = scene_;
  for (const Actor& actor : scene.actors) {
    const bool can_be_used = !world::broken_rule(actor) && find(frame, actor) == nullptr;
    if (can_be_used) {
      frame.actors.push_back(actor);
    }
    taken.degraded = taken.degraded || !can_be_used;
  }
  scene_ = frame;
  seen_at_ = frame.time;
  if (!taken.new_drive && frame.time < delivered_) {  // time does not go back
    taken = carry_on_to(delivered_);
  }
  delivered_ = taken.new_drive ? frame.time : std::max(delivered_, frame.time);
  if (!taken.new_drive && taken.usable) {
    carry_on_unusable(before, scene);
  }
  return taken;
}

void Intake::carry_on_unusable(const Scene& before, const Scene& came) noexcept {
  const double dt = scene_.time - before.time;
  for (const Actor& known : before.actors) {
    const bool is_left_out = find(scene_, known) == nullptr && find(came, known) != nullptr;
    if (!is_left_out || known.age + dt > longest_carried || scene_.actors.full()) {
      continue;
    }
    const Actor carried = moved_on(known, dt);
    if (!world::broken_rule(carried)) {
      scene_.actors.push_back(carried);
    }
  }
}

IntakeResult Intake::carry_on(double now) noexcept {
  return carry_on_to(now - began_);
}

IntakeResult Intake::carry_on_to(double time) noexcept {
  const bool follows = time >= scene_.time && seen_at_ && time <= *seen_at_ + longest_carried;
  if (!follows || !move_on(time - scene_.time)) {
    return {.usable = false, .degraded = true};
  }
  scene_.time = time;
  delivered_ = std::max(delivered_, time);
  return {.usable = true, .degraded = true};
}

bool Intake::move_on(double dt) noexcept {
  if (!(dt > 0.0)) {
    return true;
  }
  Scene frame = frame_of(scene_);
  frame.ego = moved_on(scene_.ego, dt);
  if (world::broken_rule(frame)) {
    return false;
  }
  for (const Actor& actor : scene_.actors) {
    const Actor carried = moved_on(actor, dt);
    if (!world::broken_rule(carried)) {
      frame.actors.push_back(carried);
    }
  }
  scene_ = frame;
  return true;
}

}  // namespace saca::reflex

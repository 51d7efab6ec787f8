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

/// As it moves now: on the arc of its turning rate, with its acceleration, until rest.
EgoState moved_on(EgoState ego, double dt) {
  const double speed = std::max(0.0, ego.v_B.x + ego.a_B.x * dt);
  const double rest = ego.a_B.x < 0.0 ? std::min(dt, ego.v_B.x / -ego.a_B.x) : dt;
  const double driven = std::max(0.0, ego.v_B.x * rest + 0.5 * ego.a_B.x * rest * rest);
  const double turned = ego.yaw_rate * rest;
  ego.X_WB.p = ego.X_WB.p + rotated({driven, ego.v_B.y * rest}, ego.X_WB.yaw + 0.5 * turned);
  ego.X_WB.yaw = wrap_angle(ego.X_WB.yaw + turned);
  ego.v_B = speed > 0.0 ? Vec2{speed, ego.v_B.y} : Vec2{};
  ego.yaw_rate = speed > 0.0 ? ego.yaw_rate : 0.0;
  return ego;
}

}  // namespace

IntakeResult Intake::take(const Scene& scene) noexcept {
  Scene frame = scene;
  frame.time = 0.0;
  frame.actors.clear();
  const bool has_time = std::abs(scene.time) <= latest;
  if (!has_time || world::broken_rule(frame)) {
    return carry_on(has_time ? scene.time : began_ + delivered_);
  }
  IntakeResult taken{.usable = true};
  frame.time = scene.time - began_;
  taken.new_drive =
      !seen_at_ || std::abs(frame.time - delivered_) > longest_gap || frame.time > longest_drive;
  if (taken.new_drive) {
    began_ = scene.time;
    frame.time = 0.0;
  } else if (frame.time < delivered_) {
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
  if (!taken.new_drive) {
    for (const Actor& known : before.actors) {  // of those who came and could not be used
      const double dt = frame.time - before.time;
      if (find(frame, known) == nullptr && find(scene, known) != nullptr &&
          known.age + dt <= longest_carried && !frame.actors.full()) {
        frame.actors.push_back(moved_on(known, dt));
      }
    }
  }
  scene_ = frame;
  seen_at_ = frame.time;
  delivered_ = frame.time;
  return taken;
}

IntakeResult Intake::carry_on(double now) noexcept {
  const double time = now - began_;
  const bool follows = time >= scene_.time && seen_at_ && time <= *seen_at_ + longest_carried;
  if (!follows) {
    return {.usable = false, .degraded = true};
  }
  const double dt = time - scene_.time;
  if (dt > 0.0) {
    scene_.ego = moved_on(scene_.ego, dt);
    for (Actor& actor : scene_.actors) {
      actor = moved_on(actor, dt);
    }
    scene_.time = time;
  }
  delivered_ = std::max(delivered_, time);
  return {.usable = true, .degraded = true};
}

}  // namespace saca::reflex

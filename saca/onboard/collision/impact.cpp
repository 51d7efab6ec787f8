#include "saca/onboard/collision/impact.h"

#include <algorithm>
#include <cmath>

#include "saca/onboard/collision/approach.h"
#include "saca/onboard/collision/collision_impulse.h"
#include "saca/onboard/collision/loss.h"

namespace saca::collision {
namespace {

using world::Actor;
using world::ActorKind;
using world::Beyond;
using world::Scene;

ImpactBody moving(ImpactBody body, const Instant& now) {
  body.p_W = now.X_WB.p;
  body.v_W = now.v_W;
  body.yaw_rate = now.yaw_rate;
  return body;
}

ImpactBody ego_body(const Scene& scene, const Instant& ego) {
  return moving(free_body(scene.ego_mass, scene.ego_footprint), ego);
}

// Mass and inertia of an obstacle are those of the ground: its inverses stay 0.
ImpactBody other_body(const Actor& actor, const Instant& now) {
  const bool fixed = actor.kind == ActorKind::obstacle;
  return moving(fixed ? ImpactBody{} : free_body(actor.mass, actor.footprint), now);
}

// Closing speed that counts for somebody outside a vehicle: see data/harm.toml.
double hurting_speed(Vec2 v_W, Vec2 n_W, double friction) {
  const double approach = std::max(-dot(v_W, n_W), 0.0);
  const double sliding = std::abs(dot(v_W, {-n_W.y, n_W.x}));
  return std::hypot(approach, std::min(sliding, friction * approach));
}

// Unit vector from the road to what stands beyond its edge, where the ego comes nearest to it.
Vec2 outwards(const Scene& scene, Side side, const Pose& X_WB) {
  const Vec2 p_W = outermost(scene.road, side, scene.ego_footprint, X_WB);
  const double lane_yaw = X_WB.yaw - to_lane(scene.road, {p_W, X_WB.yaw}).heading;
  return rotated({0.0, side == Side::left ? 1.0 : -1.0}, lane_yaw);
}

}  // namespace

Instant instant_at(const manoeuvre::EgoMotion& motion, double time) {
  const world::Track& track = motion.track;
  const Pose X_WB = pose_at(track, time);
  const double steps = (time - track.start) / track.step;
  const auto last = static_cast<double>(track.X_WA.size() - 1);
  if (steps > last + 1e-6) {
    return {X_WB, {}, 0.0};
  }
  const double place = std::clamp(steps, 0.0, last);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, track.X_WA.size() - 1);
  const double share = place - static_cast<double>(low);
  const Vec2 v_B = motion.v_B[low] + share * (motion.v_B[high] - motion.v_B[low]);
  return {X_WB, rotated(v_B, X_WB.yaw),
          motion.yaw_rate[low] + share * (motion.yaw_rate[high] - motion.yaw_rate[low])};
}

Instant instant_at(const world::Track& track, double time) {
  return {pose_at(track, time), velocity_at(track, time), yaw_rate_at(track, time)};
}

Impact meet(const Scene& scene, std::size_t index, const Instant& ego, const Instant& other,
            double time, const HarmModel& harm) {
  const Actor& actor = scene.actors[index];
  const Touch at = touch(scene.ego_footprint, ego.X_WB, actor.footprint, other.X_WB, harm.depth);
  const ImpactBody mine = ego_body(scene, ego);
  const ImpactBody theirs = other_body(actor, other);
  ImpactLaw law = harm.law;
  if (unprotected(actor.kind)) {
    law.restitution = 0.0;
  }
  const CollisionImpulse impulse = collision_impulse(mine, theirs, at.p_W, at.n_W, law);

  Impact impact;
  Contact& contact = impact.contact;
  contact.time = time;
  contact.actor = index;
  contact.ego_face = struck_face(scene.ego_footprint, rotated(at.n_W, -ego.X_WB.yaw));
  contact.other_face = struck_face(actor.footprint, rotated(-at.n_W, -other.X_WB.yaw));
  contact.p_W = at.p_W;
  contact.n_W = at.n_W;
  contact.v_rel_W = other.v_W - ego.v_W;
  contact.relative_speed = norm(contact.v_rel_W);
  contact.ego_delta_v = impulse.a_delta_v;
  contact.other_delta_v = impulse.b_delta_v;
  contact.ego_spin = impulse.a_spin;
  contact.other_spin = impulse.b_spin;
  impact.loss = collision_loss(contact.ego_face, contact.relative_speed);
  impact.ego = occupant_injury(harm, contact.ego_face, contact.ego_delta_v);
  const Vec2 v_W = relative_velocity_at(mine, theirs, at.p_W);
  impact.other =
      unprotected(actor.kind)
          ? unprotected_injury(harm, actor.kind, hurting_speed(v_W, at.n_W, harm.law.friction))
          : occupant_injury(harm, contact.other_face, contact.other_delta_v);
  impact.ego_change_W = -mine.inverse_mass * impulse.impulse_W;
  impact.other_change_W = theirs.inverse_mass * impulse.impulse_W;
  impact.ego_after = {ego.X_WB, ego.v_W + impact.ego_change_W, ego.yaw_rate + impulse.a_spin};
  impact.other_after = {other.X_WB, other.v_W + impact.other_change_W,
                        other.yaw_rate + impulse.b_spin};
  return impact;
}

Impact leave(const Scene& scene, Side side, const Instant& ego, double time,
             const HarmModel& harm) {
  const Beyond what = beyond(scene.road, side);
  const double speed = norm(ego.v_W);
  const double share = harm.speed_share[static_cast<std::size_t>(what)];
  const Vec2 out_W = outwards(scene, side, ego.X_WB);

  Impact impact;
  impact.ego_after = ego;
  Contact& contact = impact.contact;
  contact.time = time;
  contact.edge = side;
  contact.v_rel_W = -ego.v_W;
  contact.relative_speed = speed;
  if (what == Beyond::barrier) {
    contact.p_W = foremost(scene.ego_footprint, ego.X_WB, out_W, harm.depth);
    contact.n_W = out_W;
    const ImpactBody mine = ego_body(scene, ego);
    const CollisionImpulse impulse = collision_impulse(mine, {}, contact.p_W, out_W, harm.law);
    contact.ego_delta_v = impulse.a_delta_v;
    contact.ego_spin = impulse.a_spin;
    impact.ego_change_W = -mine.inverse_mass * impulse.impulse_W;
    impact.ego_after.v_W = ego.v_W + impact.ego_change_W;
    impact.ego_after.yaw_rate += impulse.a_spin;
  } else {
    contact.p_W = outermost(scene.road, side, scene.ego_footprint, ego.X_WB);
    contact.n_W = speed > 0.0 ? (1.0 / speed) * ego.v_W : out_W;
    contact.ego_delta_v = share * speed;
    if (world::is_hard(what)) {
      contact.ego_spin = -ego.yaw_rate;
      impact.ego_after = {ego.X_WB, {}, 0.0};
    }
  }
  contact.ego_face = struck_face(scene.ego_footprint, rotated(contact.n_W, -ego.X_WB.yaw));
  impact.loss = collision_loss(contact.ego_face, share * speed);
  impact.ego = occupant_injury(harm, contact.ego_face, contact.ego_delta_v);
  return impact;
}

Impact pressed_on(const Impact& first, const Impact& more, const HarmModel& harm) {
  Impact both = first;
  both.ego_change_W = first.ego_change_W + more.ego_change_W;
  both.other_change_W = first.other_change_W + more.other_change_W;
  both.ego_after = more.ego_after;
  both.other_after = more.other_after;
  Contact& contact = both.contact;
  contact.ego_delta_v = norm(both.ego_change_W);
  contact.other_delta_v = norm(both.other_change_W);
  contact.ego_spin += more.contact.ego_spin;
  contact.other_spin += more.contact.other_spin;
  both.ego = occupant_injury(harm, contact.ego_face, contact.ego_delta_v);
  both.other = occupant_injury(harm, contact.other_face, contact.other_delta_v);
  return both;
}

double closing_speed(const Scene& scene, std::size_t index, const Instant& ego,
                     const Instant& other, const HarmModel& harm) {
  const Actor& actor = scene.actors[index];
  const Touch at = touch(scene.ego_footprint, ego.X_WB, actor.footprint, other.X_WB, harm.depth);
  return -dot(at.n_W, relative_velocity_at(moving({}, ego), moving({}, other), at.p_W));
}

double closing_speed(const Scene& scene, Side side, const Instant& ego, const HarmModel& harm) {
  const Vec2 n_W = outwards(scene, side, ego.X_WB);
  const Vec2 p_W = foremost(scene.ego_footprint, ego.X_WB, n_W, harm.depth);
  return -dot(n_W, relative_velocity_at(moving({}, ego), {}, p_W));
}

Beyond beyond(const world::Road& road, Side side) {
  return side == Side::left ? road.left_beyond : road.right_beyond;
}

}  // namespace saca::collision

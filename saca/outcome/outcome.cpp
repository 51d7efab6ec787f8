#include "saca/outcome/outcome.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "saca/core/contract.h"
#include "saca/outcome/approach.h"
#include "saca/outcome/impact.h"
#include "saca/outcome/loss.h"

namespace saca::outcome {
namespace {

using manoeuvre::EgoMotion;
using world::Actor;
using world::ActorKind;
using world::Beyond;
using world::Scene;
using world::Track;

// Slower than this, a body stands [m/s].
constexpr double at_rest = 0.05;

// How long an ego that has recovered its lane is followed along it [s]. An assumption: enough to
// pass what it went around and to see what comes towards it; what is farther off is another
// encounter.
constexpr double goes_on = 2.0;

bool moves_at_end(const EgoMotion& motion) {
  return norm(motion.v_B.back()) > at_rest;
}
bool moves_at_end(const Track& track) {
  const auto& poses = track.X_WA;
  return poses.size() > 1 &&
         norm(poses.back().p - poses[poses.size() - 2].p) > at_rest * track.step;
}

// The motion, followed by going on along the lane at the speed and offset of its end.
EgoMotion carried_on(EgoMotion motion, const world::Road& road) {
  const world::LanePose last = to_lane(road, motion.track.X_WA.back());
  const double speed = norm(motion.v_B.back());
  const double along = speed / (1.0 - road.curvature * last.d);  // what s gains per second
  const int num_steps = static_cast<int>(std::ceil(goes_on / motion.track.step));
  for (int k = 1; k <= num_steps; ++k) {
    const double s = last.s + along * (k * motion.track.step);
    motion.track.X_WA.push_back(from_lane(road, {s, last.d, last.heading}));
    motion.v_B.push_back(rotated({speed, 0.0}, -last.heading));
    motion.yaw_rate.push_back(along * road.curvature);
  }
  return motion;
}

// How the ego moves at one instant.
struct Instant {
  Pose X_WB;
  Vec2 v_W;
  double yaw_rate = 0.0;
};

Instant ego_at(const EgoMotion& motion, double time) {
  const Track& track = motion.track;
  const Pose X_WB = pose_at(track, time);
  if (time > end_time(track)) {
    return {X_WB, {}, 0.0};  // only an ego at rest is asked for beyond its motion
  }
  const double place = std::clamp((time - track.start) / track.step, 0.0,
                                  static_cast<double>(track.X_WA.size() - 1));
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, track.X_WA.size() - 1);
  const double share = place - static_cast<double>(low);
  const Vec2 v_B = motion.v_B[low] + share * (motion.v_B[high] - motion.v_B[low]);
  return {X_WB, rotated(v_B, X_WB.yaw),
          motion.yaw_rate[low] + share * (motion.yaw_rate[high] - motion.yaw_rate[low])};
}

ImpactBody moving(ImpactBody body, const Pose& X_WB, Vec2 v_W, double yaw_rate) {
  body.p_W = X_WB.p;
  body.v_W = v_W;
  body.yaw_rate = yaw_rate;
  return body;
}

ImpactBody ego_body(const Scene& scene, const Instant& ego) {
  return moving(free_body(scene.ego_mass, scene.ego_footprint), ego.X_WB, ego.v_W, ego.yaw_rate);
}

// What a contact costs, before it is known which one comes first.
struct Cost {
  Contact contact;
  double loss = 0.0;
  double harm = 0.0;
};

// Closing speed that counts for somebody outside a vehicle: see data/harm.toml.
double closing_speed(Vec2 v_W, Vec2 n_W, double friction) {
  const double approach = std::max(-dot(v_W, n_W), 0.0);
  const double sliding = std::abs(dot(v_W, {-n_W.y, n_W.x}));
  return std::hypot(approach, std::min(sliding, friction * approach));
}

double harm_of_meeting(const Contact& contact, const Actor& actor, double closing,
                       const HarmModel& model) {
  const double people = model.people[static_cast<std::size_t>(actor.kind)];
  const double other = unprotected(actor.kind)
                           ? unprotected_harm(model, actor.kind, closing)
                           : occupant_harm(model, contact.other_face, contact.other_delta_v);
  return actor.existence *
         (model.ego_people * occupant_harm(model, contact.ego_face, contact.ego_delta_v) +
          people * other);
}

Cost meet(const EgoMotion& motion, const Scene& scene, std::size_t index, const Track& track,
          double time, const HarmModel& model) {
  const Actor& actor = scene.actors[index];
  const Instant ego = ego_at(motion, time);
  const Pose X_WA = pose_at(track, time);
  const Touch at = touch(scene.ego_footprint, ego.X_WB, actor.footprint, X_WA, model.depth);

  const ImpactBody mine = ego_body(scene, ego);
  // Mass and inertia of an obstacle are those of the ground: its inverses stay 0.
  const bool fixed = actor.kind == ActorKind::obstacle;
  const ImpactBody other = moving(fixed ? ImpactBody{} : free_body(actor.mass, actor.footprint),
                                  X_WA, velocity_at(track, time), yaw_rate_at(track, time));
  ImpactLaw law = model.law;
  if (unprotected(actor.kind)) {
    law.restitution = 0.0;
  }
  const Impact blow = impact(mine, other, at.p_W, at.n_W, law);

  Cost cost;
  Contact& contact = cost.contact;
  contact.time = time;
  contact.actor = index;
  contact.ego_face = struck_face(scene.ego_footprint, rotated(at.n_W, -ego.X_WB.yaw));
  contact.other_face = struck_face(actor.footprint, rotated(-at.n_W, -X_WA.yaw));
  contact.p_W = at.p_W;
  contact.n_W = at.n_W;
  contact.v_rel_W = other.v_W - mine.v_W;
  contact.relative_speed = norm(contact.v_rel_W);
  contact.ego_delta_v = blow.a_delta_v;
  contact.other_delta_v = blow.b_delta_v;
  cost.loss = collision_loss(contact.ego_face, contact.relative_speed);
  const Vec2 v_W = relative_velocity_at(mine, other, at.p_W);
  cost.harm = harm_of_meeting(contact, actor, closing_speed(v_W, at.n_W, law.friction), model);
  return cost;
}

Beyond beyond(const world::Road& road, Side side) {
  return side == Side::left ? road.left_beyond : road.right_beyond;
}

Cost leave(const EgoMotion& motion, const Scene& scene, Side side, double time,
           const HarmModel& model) {
  const Instant ego = ego_at(motion, time);
  const Beyond what = beyond(scene.road, side);
  const double speed = norm(ego.v_W);

  Cost cost;
  Contact& contact = cost.contact;
  contact.time = time;
  contact.edge = side;
  contact.p_W = outermost(scene.road, side, scene.ego_footprint, ego.X_WB);
  contact.v_rel_W = -ego.v_W;
  contact.relative_speed = speed;
  const double lane_yaw = ego.X_WB.yaw - to_lane(scene.road, {contact.p_W, ego.X_WB.yaw}).heading;
  const Vec2 outwards = rotated({0.0, side == Side::left ? 1.0 : -1.0}, lane_yaw);
  const double share = model.speed_share[static_cast<std::size_t>(what)];
  if (what == Beyond::barrier) {
    contact.n_W = outwards;
    contact.ego_delta_v =
        impact(ego_body(scene, ego), {}, contact.p_W, outwards, model.law).a_delta_v;
  } else {
    contact.n_W = speed > 0.0 ? (1.0 / speed) * ego.v_W : outwards;
    contact.ego_delta_v = share * speed;
  }
  contact.ego_face = struck_face(scene.ego_footprint, rotated(contact.n_W, -ego.X_WB.yaw));
  cost.loss = collision_loss(contact.ego_face, share * speed);
  cost.harm = model.ego_people * occupant_harm(model, contact.ego_face, contact.ego_delta_v);
  return cost;
}

// The search for what ends the motion first.
struct Search {
  double until = 0.0;              ///< nothing later matters [s]
  double clearance = far_away;     ///< [m]
  std::optional<Cost> last;        ///< what ends the motion, so far
  std::optional<Cost> crossed[2];  // NOLINT: by Side; edges that do not end it
};

void search_edges(const EgoMotion& motion, const Scene& scene, const HarmModel& model,
                  Search& search) {
  for (const Side side : {Side::left, Side::right}) {
    const EdgeApproach edge =
        edge_approach(scene.road, side, scene.ego_footprint, motion.track, search.clearance);
    const Beyond what = beyond(scene.road, side);
    if (what != Beyond::unmarked) {
      search.clearance = std::max(0.0, edge.room);
    }
    if (!edge.crossing) {
      continue;
    }
    if (!stops_the_ego(what)) {
      search.crossed[static_cast<std::size_t>(side)] =
          leave(motion, scene, side, *edge.crossing, model);
    } else if (!search.last || *edge.crossing < search.until) {
      search.last = leave(motion, scene, side, *edge.crossing, model);
      search.until = *edge.crossing;
    }
  }
}

void search_actors(const EgoMotion& motion, const Scene& scene, std::span<const Track> tracks,
                   const HarmModel& model, Search& search) {
  const Mover ego(scene.ego_footprint, motion.track);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Mover other(scene.actors[i].footprint, tracks[i]);
    const double of_interest = search.last ? 0.0 : search.clearance;
    const double known = moves_at_end(tracks[i]) ? end_time(tracks[i]) : search.until;
    if (known < motion.track.start) {
      continue;
    }
    const Approach found =
        approach(ego, other, motion.track.start, std::min(known, search.until), of_interest);
    search.clearance = std::min(search.clearance, found.distance);
    if (found.contact && (!search.last || *found.contact < search.until)) {
      search.last = meet(motion, scene, i, tracks[i], *found.contact, model);
      search.until = *found.contact;
    }
  }
}

double last_time(const EgoMotion& motion, std::span<const Track> tracks) {
  double time = end_time(motion.track);
  if (motion.ended && !moves_at_end(motion)) {
    for (const Track& track : tracks) {
      time = std::max(time, end_time(track));
    }
  }
  return time;
}

// The motion as given, or continued, judged.
Outcome judge_all(const EgoMotion& motion, const Scene& scene, std::span<const Track> tracks,
                  const HarmModel& harm) {
  Search search;
  search.until = last_time(motion, tracks);
  search_edges(motion, scene, harm, search);
  search_actors(motion, scene, tracks, harm, search);

  Outcome outcome;
  outcome.end_time = search.last ? search.until : end_time(motion.track);
  std::optional<Cost> reported = search.last;
  for (const std::optional<Cost>& crossed : search.crossed) {
    if (!crossed || crossed->contact.time > search.until) {
      continue;
    }
    outcome.harm += crossed->harm;
    if (!search.last && (!reported || crossed->contact.time < reported->contact.time)) {
      reported = crossed;
    }
  }
  if (search.last) {
    outcome.harm += search.last->harm;
  }
  outcome.clearance = search.clearance;
  if (reported) {
    outcome.contact = reported->contact;
    outcome.collision_loss = reported->loss;
    outcome.clearance = 0.0;
  }
  return outcome;
}

}  // namespace

bool stops_the_ego(world::Beyond beyond) {
  return beyond == Beyond::barrier || beyond == Beyond::trees;
}

Outcome judge(const EgoMotion& motion, const Scene& scene, std::span<const Track> tracks,
              const HarmModel& harm) {
  return judge(
      motion, scene, [&](const Track&) { return std::vector<Track>(tracks.begin(), tracks.end()); },
      harm);
}

Outcome judge(const EgoMotion& motion, const Scene& scene, const Others& others,
              const HarmModel& harm) {
  expects(!motion.track.X_WA.empty(), "the motion has at least one pose");
  expects(motion.v_B.size() == motion.track.X_WA.size() &&
              motion.yaw_rate.size() == motion.track.X_WA.size(),
          "one velocity and one yaw rate per pose");
  const bool moves_on = motion.ended && moves_at_end(motion);
  const EgoMotion whole = moves_on ? carried_on(motion, scene.road) : motion;
  const std::vector<Track> tracks = others(whole.track);
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  Outcome outcome = judge_all(whole, scene, tracks, harm);
  if (moves_on && !outcome.contact) {
    outcome.end_time = end_time(motion.track);
  }
  return outcome;
}

}  // namespace saca::outcome

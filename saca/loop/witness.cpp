#include "saca/loop/witness.h"

#include <algorithm>
#include <iterator>

#include "saca/preview/threat.h"
#include "saca/world/time_to_conflict.h"

namespace saca::loop {
namespace {

bool goes_on(const outcome::Outcome& outcome, const world::Road& road) {
  if (!outcome.contact) {
    return true;
  }
  if (!outcome.contact->edge) {
    return false;
  }
  const bool left = *outcome.contact->edge == outcome::Side::left;
  return !outcome::stops_the_ego(left ? road.left_beyond : road.right_beyond);
}

/// Beside the ego's path, a follower is a car like any other: it no longer has to react.
bool has_left_path(const world::Scene& scene, const world::Actor& follower) {
  const double ego_d = world::to_lane(scene.road, scene.ego.X_WB).d;
  return std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& now) {
    const double aside = std::abs(world::to_lane(scene.road, now.X_WA).d - ego_d);
    return now.kind == follower.kind && now.id == follower.id &&
           aside > 0.5 * (now.footprint.width + scene.ego_footprint.width) + 0.5;
  });
}

}  // namespace

std::vector<world::Track> Witness::judged_tracks(const world::Scene& scene,
                                                 std::vector<world::Track> tracks) const {
  for (const world::Actor& follower : followers_) {
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      if (scene.actors[i].kind == follower.kind && scene.actors[i].id == follower.id) {
        tracks[i] = preview::out_of_the_way(follower, scene.time);
      }
    }
  }
  return tracks;
}

std::optional<world::Scene> Witness::look(const sim::Stepper& stepper) {
  const world::Scene now = stepper.scene();
  if (!last_) {
    std::copy_if(now.actors.begin(), now.actors.end(), std::back_inserter(followers_),
                 [&](const world::Actor& actor) { return world::is_follower(now, actor); });
    last_ = now;
    return std::nullopt;
  }
  const manoeuvre::EgoMotion motion{.track = {.start = last_->time,
                                              .step = now.time - last_->time,
                                              .X_WA = {last_->ego.X_WB, now.ego.X_WB}},
                                    .v_B = {last_->ego.v_B, now.ego.v_B},
                                    .yaw_rate = {last_->ego.yaw_rate, now.ego.yaw_rate},
                                    .ended = false};
  const outcome::Outcome step =
      outcome::judge(motion, now, judged_tracks(now, stepper.tracks()), harm_);
  last_ = now;
  std::erase_if(followers_,
                [&](const world::Actor& follower) { return has_left_path(now, follower); });
  if (!goes_on(step, now.road)) {
    outcome_ = step;
    return now;
  }
  // The first edge that was crossed stays the contact, unless something worse follows.
  const double clearance = std::min(outcome_.clearance, step.clearance);
  if (!outcome_.contact) {
    outcome_ = step;
  }
  outcome_.clearance = clearance;
  outcome_.end_time = step.end_time;
  return std::nullopt;
}

}  // namespace saca::loop

#include "saca/loop/witness.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// How the actors of `now` came there since `last`: straight, in steps of the traffic.
std::vector<world::Track> since(const world::Scene& last, const world::Scene& now) {
  const double span = now.time - last.time;
  const int num_steps = std::max(1, static_cast<int>(std::lround(span / sim::Traffic::step)));
  std::vector<world::Track> tracks;
  for (const world::Actor& actor : now.actors) {
    const auto* const before =
        std::find_if(last.actors.begin(), last.actors.end(), [&](const world::Actor& other) {
          return other.kind == actor.kind && other.id == actor.id;
        });
    if (before == last.actors.end()) {
      tracks.push_back({.start = now.time, .step = sim::Traffic::step, .X_WA = {actor.X_WA}});
      continue;
    }
    world::Track track{.start = last.time, .step = span / num_steps, .X_WA = {}};
    for (int k = 0; k <= num_steps; ++k) {
      track.X_WA.push_back(between(before->X_WA, actor.X_WA, static_cast<double>(k) / num_steps));
    }
    tracks.push_back(track);
  }
  return tracks;
}

/// The same, and how they would go on from here.
outcome::Others since_and_on(std::vector<world::Track> tracks, outcome::Others others) {
  return [past = std::move(tracks), future = std::move(others)](const world::Track& X_WB) {
    std::vector<world::Track> all = past;
    const std::vector<world::Track> on = future(X_WB);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].X_WA.insert(all[i].X_WA.end(), on[i].X_WA.begin() + 1, on[i].X_WA.end());
    }
    return all;
  };
}

}  // namespace

std::optional<world::Scene> Witness::look(const sim::Stepper& stepper) {
  const world::Scene now = stepper.scene();
  if (!last_) {
    last_ = now;
    return std::nullopt;
  }
  const manoeuvre::EgoMotion motion{.track = {.start = last_->time,
                                              .step = now.time - last_->time,
                                              .X_WA = {last_->ego.X_WB, now.ego.X_WB}},
                                    .v_B = {last_->ego.v_B, now.ego.v_B},
                                    .yaw_rate = {last_->ego.yaw_rate, now.ego.yaw_rate},
                                    .ended = false};
  const std::vector<world::Track> tracks = since(*last_, now);
  const outcome::Outcome step = outcome::judge(motion, now, tracks, harm_);
  last_ = now;
  if (!goes_on(step, now.road)) {
    outcome_ = outcome::judge(motion, now, since_and_on(tracks, stepper.others()), harm_);
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

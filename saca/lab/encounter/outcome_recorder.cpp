#include "saca/lab/encounter/outcome_recorder.h"
#include "saca/thinking/rollout/collision_sequence.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::encounter {
namespace {

using manoeuvre::EgoMotion;
using world::Scene;
using world::Track;

bool goes_on(const collision::Outcome& outcome, const world::Road& road) {
  if (!outcome.contact) {
    return true;
  }
  if (!outcome.contact->edge) {
    return false;
  }
  const bool left = *outcome.contact->edge == collision::Side::left;
  return !world::is_hard(left ? road.left_beyond : road.right_beyond);
}

bool is_there(const world::Actor& actor, const Scene& scene) {
  return std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& other) {
    return other.kind == actor.kind && other.id == actor.id;
  });
}

void append(EgoMotion& motion, const world::EgoState& ego) {
  motion.track.X_WA.push_back(ego.X_WB);
  motion.v_B.push_back(ego.v_B);
  motion.yaw_rate.push_back(ego.yaw_rate);
}

Track from_sample(const Track& track, std::size_t first) {
  return {.start = track.start + track.step * static_cast<double>(first),
          .step = track.step,
          .X_WA = {track.X_WA.begin() + static_cast<std::ptrdiff_t>(first), track.X_WA.end()}};
}

/// From its last but one pose on.
Track last_step(const Track& track) {
  return from_sample(track, track.X_WA.size() < 2 ? 0 : track.X_WA.size() - 2);
}

EgoMotion last_step(const EgoMotion& motion) {
  const std::size_t n = motion.v_B.size();
  return {.track = last_step(motion.track),
          .v_B = {motion.v_B[n - 2], motion.v_B[n - 1]},
          .yaw_rate = {motion.yaw_rate[n - 2], motion.yaw_rate[n - 1]}};
}

/// Of somebody who has not appeared yet.
Track absent(const Scene& scene, std::size_t actor) {
  constexpr double later = 1.0;  // [s]
  return {.start = scene.time + later, .X_WA = {scene.actors[actor].X_WA}};
}

/// What they did, and from its end on what they will do.
std::vector<Track> carried_on(std::vector<Track> past, const std::vector<Track>& future) {
  for (std::size_t i = 0; i < past.size(); ++i) {
    if (past[i].X_WA.empty()) {
      past[i] = future[i];
    } else {
      past[i].X_WA.insert(past[i].X_WA.end(), future[i].X_WA.begin() + 1, future[i].X_WA.end());
    }
  }
  return past;
}

}  // namespace

bool OutcomeRecorder::look(const sim::Stepper& stepper) {
  expects(!afterwards_, "the motion goes on");
  const Scene there = stepper.scene();
  scene_ = stepper.whole_scene();
  others_.resize(scene_.actors.size(), {.step = sim::Traffic::step, .X_WA = {}});
  if (ego_.v_B.empty()) {
    ego_.track = {.start = scene_.time, .step = sim::Traffic::step, .X_WA = {}};
  }
  append(ego_, scene_.ego);
  expects(std::abs(end_time(ego_.track) - scene_.time) < 1e-6, "one look at every step of traffic");
  for (std::size_t i = 0; i < others_.size(); ++i) {
    Track& track = others_[i];
    if (is_there(scene_.actors[i], there)) {
      track.start = track.X_WA.empty() ? scene_.time : track.start;
      track.X_WA.push_back(scene_.actors[i].X_WA);
    }
  }
  if (ego_.v_B.size() < 2) {
    return false;
  }
  std::vector<Track> steps;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    steps.push_back(others_[i].X_WA.empty() ? absent(scene_, i) : last_step(others_[i]));
  }
  if (goes_on(rollout::judge(last_step(ego_), scene_, steps, harm_), scene_.road)) {
    return false;
  }
  afterwards_ = stepper.others();
  return true;
}

collision::Outcome OutcomeRecorder::outcome_since(double time) const {
  expects(!afterwards_, "no contact has ended the motion");
  const auto skipped = [&](const Track& track) {
    const double samples = std::ceil((time - track.start) / track.step - 1e-6);
    return static_cast<std::size_t>(std::max(0.0, samples));
  };
  const std::size_t first = skipped(ego_.track);
  expects(first < ego_.v_B.size(), "something was seen from then on");
  EgoMotion ego{.track = from_sample(ego_.track, first), .v_B = {}, .yaw_rate = {}};
  ego.v_B.assign(ego_.v_B.begin() + static_cast<std::ptrdiff_t>(first), ego_.v_B.end());
  ego.yaw_rate.assign(ego_.yaw_rate.begin() + static_cast<std::ptrdiff_t>(first),
                      ego_.yaw_rate.end());
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const std::size_t gone = skipped(others_[i]);
    tracks.push_back(others_[i].X_WA.empty() || gone >= others_[i].X_WA.size()
                         ? absent(scene_, i)
                         : from_sample(others_[i], gone));
  }
  return rollout::judge(ego, scene_, tracks, harm_);
}

collision::Outcome OutcomeRecorder::outcome() const {
  expects(!ego_.v_B.empty(), "something was seen");
  if (!afterwards_) {
    return outcome_since(ego_.track.start);
  }
  return rollout::judge(
      ego_, scene_, [this](const EgoMotion& ego) { return carried_on(others_, afterwards_(ego)); },
      harm_);
}

}  // namespace saca::encounter

#include "saca/loop/witness.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "saca/core/contract.h"

namespace saca::loop {
namespace {

using manoeuvre::EgoMotion;
using world::Scene;
using world::Track;

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

/// From its last but one pose on.
Track last_step(const Track& track) {
  const std::size_t first = track.X_WA.size() < 2 ? 0 : track.X_WA.size() - 2;
  Track step{.start = track.start + track.step * static_cast<double>(first),
             .step = track.step,
             .X_WA = {}};
  std::copy(track.X_WA.begin() + static_cast<std::ptrdiff_t>(first), track.X_WA.end(),
            std::back_inserter(step.X_WA));
  return step;
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

bool Witness::look(const sim::Stepper& stepper) {
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
  if (goes_on(outcome::judge(last_step(ego_), scene_, steps, harm_), scene_.road)) {
    return false;
  }
  afterwards_ = stepper.others();
  return true;
}

outcome::Outcome Witness::outcome() const {
  expects(!ego_.v_B.empty(), "something was seen");
  if (!afterwards_) {
    std::vector<Track> tracks = others_;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      tracks[i] = tracks[i].X_WA.empty() ? absent(scene_, i) : tracks[i];
    }
    return outcome::judge(ego_, scene_, tracks, harm_);
  }
  return outcome::judge(
      ego_, scene_, [this](const EgoMotion& ego) { return carried_on(others_, afterwards_(ego)); },
      harm_);
}

}  // namespace saca::loop

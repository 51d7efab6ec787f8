#include "saca/sim/stepper.h"

#include <algorithm>
#include <iterator>

#include "saca/core/contract.h"
#include "saca/sim/motion.h"

namespace saca::sim {
namespace {

constexpr double track_step = 0.01;      // [s]
constexpr double difference_time = 0.5;  // [s], backward differences of velocity and heading

world::Actor perceived(const ScenarioActor& actor, const world::Track& track, double time) {
  world::Actor seen{.id = actor.id,
                    .kind = actor.kind,
                    .footprint = actor.footprint,
                    .mass = actor.mass,
                    .X_WA = world::pose_at(track, time),
                    .v_W = world::velocity_at(track, time)};
  const double before = time - difference_time;
  if (before >= track.start) {
    constexpr double rate = 1.0 / difference_time;
    seen.a_W = rate * (seen.v_W - world::velocity_at(track, before));
    seen.yaw_rate = rate * wrap_angle(seen.X_WA.yaw - world::pose_at(track, before).yaw);
  }
  return seen;
}

}  // namespace

Stepper::Stepper(const Scenario& scenario, const vehicle::Vehicle& car)
    : scenario_(scenario), car_(car) {
  for (std::size_t i = 0; i < scenario.actors.size(); ++i) {
    tracks_.push_back(actor_track(scenario, i, track_step));
  }
}

void Stepper::take_the_wheel() {
  expects(!driven_, "the wheel is taken once");
  state_ = manoeuvre::rolling_state(car_, ego_at(scenario_, time()), scenario_.grip);
  driven_ = true;
}

void Stepper::advance(const vehicle::Command& command) {
  if (driven_) {
    state_ = vehicle::step(car_, state_, command, scenario_.grip, step);
  }
  ++num_steps_;
}

world::EgoState Stepper::ego() const {
  return driven_ ? manoeuvre::ego_state(state_) : ego_at(scenario_, time());
}

world::Scene Stepper::scene() const {
  world::Scene scene{.time = time(),
                     .ego = ego(),
                     .ego_footprint = manoeuvre::footprint(car_),
                     .ego_mass = car_.mass,
                     .road = scenario_.road,
                     .grip = scenario_.grip};
  for (std::size_t i = 0; i < scenario_.actors.size(); ++i) {
    if (is_there(tracks_[i])) {
      scene.actors.push_back(perceived(scenario_.actors[i], tracks_[i], time()));
    }
  }
  return scene;
}

std::vector<world::Track> Stepper::tracks() const {
  std::vector<world::Track> there;
  std::copy_if(tracks_.begin(), tracks_.end(), std::back_inserter(there),
               [&](const world::Track& track) { return is_there(track); });
  return there;
}

}  // namespace saca::sim

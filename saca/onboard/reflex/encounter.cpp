#include "saca/onboard/reflex/encounter.h"

#include <cmath>

namespace saca::reflex {
namespace {

/// At rest, as far as sensors can tell: they say 0 of nothing.
bool stands(const vehicle::VehicleState& state) {
  constexpr double slowest = 0.05;     // [m/s]
  constexpr double least_turn = 0.02;  // [rad/s]
  return norm(state.v_B) <= slowest && std::abs(state.yaw_rate) <= least_turn;
}

}  // namespace

bool Encounter::look(const world::Scene& scene, const Reflex& answer) {
  if (answer.refused_scene) {
    return false;  // what is under way goes on
  }
  grip_ = scene.grip;
  if (answer.triggered || answer.switched) {
    begin(answer.plan, scene);
  }
  if (finished_ && execution_ && !execution_->ends_at_rest()) {
    execution_.reset();
  }
  meets_somebody_ = meets_somebody_ || answer.threat || execution_;
  constexpr double moves = 0.1;  // [m/s]
  const bool rests = finished_ && norm(scene.ego.v_B) < moves;
  if (!meets_somebody_ || answer.threat || (execution_ && !rests)) {
    quiet_.reset();
    return false;
  }
  quiet_ = quiet_.value_or(scene.time);
  return scene.time >= *quiet_ + quiet_time;
}

void Encounter::begin(const manoeuvre::Plan& plan, const world::Scene& scene) {
  finished_ = false;
  if (plan.policy == manoeuvre::PolicyId::no_intervention) {
    execution_.reset();
    return;
  }
  execution_.emplace(*car_, plan, scene);
}

vehicle::Command Encounter::control(const vehicle::VehicleState& state, double dt) noexcept {
  if (!execution_) {
    return {};
  }
  const vehicle::Command command = execution_->control(state, grip_, dt);
  finished_ = finished_ || execution_->finished() || (execution_->ends_at_rest() && stands(state));
  return command;
}

void Encounter::begin_anew() noexcept {
  execution_.reset();
  quiet_.reset();
  meets_somebody_ = false;
  finished_ = false;
}

}  // namespace saca::reflex

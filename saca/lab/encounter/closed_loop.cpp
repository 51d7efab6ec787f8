#include "saca/lab/encounter/closed_loop.h"
#include "saca/thinking/rollout/collision_sequence.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/thinking/preview/caution.h"
#include "saca/thinking/preview/previewed_threat.h"

namespace saca::encounter {
namespace {

using world::Scene;

constexpr double rest_after_end = 2.0;  // [s] that is still watched, as rollout::judge looks on

/// The ego has stopped, and somebody behind it has not.
bool is_approached(const Scene& scene) {
  constexpr double moves = 0.1;  // [m/s]
  return norm(scene.ego.v_B) < moves &&
         std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
           return norm(actor.v_W) > moves && world::is_follower(scene, actor);
         });
}

const Stage& complete(const Stage& stage) {
  expects(stage.scenario != nullptr && stage.car != nullptr && stage.harm != nullptr &&
              stage.intent != nullptr,
          "scenario, car, harm and intent are given");
  return stage;
}

/// Torques that decelerate the car by this much at most, shared among the wheels as they were.
void limit(vehicle::PerWheel& torque, const vehicle::Vehicle& car, double deceleration) {
  const double wanted = std::accumulate(torque.begin(), torque.end(), 0.0);
  const double most = car.mass * deceleration * car.wheel_radius;
  if (wanted > most) {
    for (double& each : torque) {
      each *= most / wanted;
    }
  }
}

}  // namespace

ClosedLoop::ClosedLoop(const Stage& stage)
    : stage_(&complete(stage)),
      stepper_(*stage.scenario, *stage.car, stage.chance),
      observer_(*stage.intent),
      recorder_(*stage.harm) {}

std::optional<Error> ClosedLoop::look() {
  const auto broken = [&](const Scene& scene) -> std::optional<Error> {
    const auto rule = world::broken_rule(scene);
    return rule ? std::optional(Error{Error::Code::out_of_range,
                                      fmt::format("{}: at {:.2f} s: a scene must hold: {}",
                                                  stage_->scenario->name, time(), *rule)})
                : std::nullopt;
  };
  if (auto problem = broken(stepper_.scene())) {
    return problem;
  }
  seen_ = stepper_.perceive();
  if (auto problem = broken(seen_)) {
    return problem;
  }
  beliefs_ = observer_.look(seen_);
  tracks_.look(seen_);
  return std::nullopt;
}

std::optional<reflex::Threat> ClosedLoop::wake() {
  if (driven()) {
    return std::nullopt;
  }
  const auto threat =
      preview::previewed_threat(seen_, beliefs_, preview::hard_driving(), stage_->thresholds);
  if (threat) {
    take_the_wheel();
  }
  return threat;
}

void ClosedLoop::take_the_wheel() {
  stepper_.take_the_wheel();
  keep_lane_and_speed();
}

void ClosedLoop::keep_lane_and_speed() {
  execution_.emplace(*stage_->car, manoeuvre::doing_nothing, seen_);
}

std::optional<std::string> ClosedLoop::carry_out(manoeuvre::Plan plan, double deceleration) {
  if (!driven()) {
    take_the_wheel();
  }
  execution_.emplace(*stage_->car, plan, seen_);
  limit_braking(deceleration);
  acts_ = true;
  finished_ = false;
  ended_.reset();
  return execution_->refused() ? manoeuvre::refusal(*stage_->car, plan, seen_) : std::nullopt;
}

void ClosedLoop::limit_braking(double deceleration) {
  expects(deceleration > 0.0, "deceleration > 0");
  deceleration_ = deceleration;
}

void ClosedLoop::keep() {
  if (driven()) {
    contact_ = recorder_.look(stepper_);
    kept_ = true;
  }
}

void ClosedLoop::advance() {
  note_end();
  move([this](const vehicle::VehicleState& state) { return own_command(state); });
  finished_ = execution_ && execution_->finished();
}

void ClosedLoop::advance(Avoider& avoider) {
  const bool has_plan = avoider.plan().has_value();
  if (has_plan && !driven()) {
    take_the_wheel();
  }
  if (avoids_ && !has_plan) {
    keep_lane_and_speed();
  }
  avoids_ = has_plan;
  finished_ = avoider.finished();
  if (has_plan && !finished_) {
    acts_ = true;
    ended_.reset();
  }
  note_end();
  move([&](const vehicle::VehicleState& state) {
    return has_plan ? avoider.control(state, sim::Stepper::step) : own_command(state);
  });
  finished_ = avoider.finished();
}

void ClosedLoop::note_end() {
  if (acts_ && !ended_ && finished_) {
    ended_ = time();
  }
}

template <class Command>
void ClosedLoop::move(Command&& command) {
  for (int k = 0; k < steps_per_look; ++k) {
    stepper_.advance(driven() ? command(stepper_.car_state()) : vehicle::Command{});
  }
}

vehicle::Command ClosedLoop::own_command(const vehicle::VehicleState& state) {
  vehicle::Command command = execution_->control(state, seen_.grip, sim::Stepper::step);
  limit(command.brake_torque, *stage_->car, deceleration_);
  return command;
}

bool ClosedLoop::over() const {
  if (contact_ || stepper_.over()) {
    return true;
  }
  return ended_ && time() > *ended_ + rest_after_end &&
         !reflex::nearest_threat(seen_, stage_->thresholds.preview,
                                 stage_->thresholds.trigger_tolerance) &&
         !is_approached(stepper_.scene());
}

std::optional<collision::Outcome> ClosedLoop::outcome() const {
  return kept_ ? std::optional(recorder_.outcome()) : std::nullopt;
}

double ClosedLoop::steering() const {
  return driven() ? stepper_.car_state().steering : 0.0;
}

}  // namespace saca::encounter

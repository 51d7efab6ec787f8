#include "saca/eval/moment.h"

#include <cmath>

#include "saca/core/contract.h"
#include "saca/sim/stepper.h"

namespace saca::eval {
namespace {

constexpr int steps_per_look = 10;  // 10 ms

void advance_one_look(sim::Stepper& stepper) {
  for (int k = 0; k < steps_per_look; ++k) {
    stepper.advance({});
  }
}

void advance_to(sim::Stepper& stepper, const sim::Scenario& scenario, double time) {
  expects(time >= 0.0 && time <= scenario.duration, "time in [0, duration]");
  const long num_looks = std::lround(time / (steps_per_look * sim::Stepper::step));
  for (long k = 0; k < num_looks; ++k) {
    advance_one_look(stepper);
  }
}

}  // namespace

std::optional<double> trigger_time(const sim::Scenario& scenario, const manoeuvre::Car& car,
                                   const preview::Thresholds& thresholds) {
  sim::Stepper stepper(scenario, car);
  while (!stepper.over()) {
    if (preview::nearest_threat(stepper.scene(), thresholds.trigger,
                                thresholds.trigger_tolerance)) {
      return stepper.time();
    }
    advance_one_look(stepper);
  }
  return std::nullopt;
}

world::Scene scene_at(const sim::Scenario& scenario, const manoeuvre::Car& car, double time) {
  sim::Stepper stepper(scenario, car);
  advance_to(stepper, scenario, time);
  return stepper.scene();
}

Moment moment_at(const sim::Scenario& scenario, const manoeuvre::Car& car, double time,
                 const sim::Chance& chance) {
  sim::Stepper stepper(scenario, car, chance);
  advance_to(stepper, scenario, time);
  world::Scene scene = stepper.whole_scene();
  scene.grip = sim::believed_grip(scenario);
  stepper.take_the_wheel();
  return {.scene = scene, .others = stepper.others(), .grip = scenario.grip, .unknown = chance.car};
}

std::array<loop::Hindsight, manoeuvre::num_policies> attempts(const Moment& moment,
                                                              const manoeuvre::Car& car,
                                                              const outcome::HarmModel& harm) {
  return loop::hindsight(moment.scene, moment.others, moment.grip, car, harm, moment.unknown);
}

}  // namespace saca::eval

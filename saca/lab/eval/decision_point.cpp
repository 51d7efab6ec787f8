#include "saca/lab/eval/decision_point.h"

#include <cmath>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/sim/stepper.h"

namespace saca::eval {
namespace {

constexpr int steps_per_look = 10;  // 10 ms

void advance_one_look(sim::Stepper& stepper) {
  for (int k = 0; k < steps_per_look; ++k) {
    stepper.advance({});
  }
}

void advance_to(sim::Stepper& stepper, const scenario::Scenario& scenario, double time) {
  expects(time >= 0.0 && time <= scenario.duration, "time in [0, duration]");
  const long num_looks = std::lround(time / (steps_per_look * sim::Stepper::step));
  for (long k = 0; k < num_looks; ++k) {
    advance_one_look(stepper);
  }
}

/// Goes on to the first look at which the trigger fires; false: it never does.
bool advance_to_trigger(sim::Stepper& stepper, const reflex::Thresholds& thresholds) {
  while (!stepper.over()) {
    if (reflex::triggering_threat(stepper.scene(), thresholds)) {
      return true;
    }
    advance_one_look(stepper);
  }
  return false;
}

DecisionPoint point_of(sim::Stepper& stepper, const scenario::Scenario& scenario,
                       const scenario::Chance& chance) {
  world::Scene scene = stepper.whole_scene();
  scene.grip = scenario::believed_grip(scenario);
  stepper.take_the_wheel();
  return {.scene = scene,
          .others = stepper.others(),
          .grip = scenario.grip,
          .perturbation = chance.car};
}

}  // namespace

std::optional<double> trigger_time(const scenario::Scenario& scenario, const manoeuvre::Car& car,
                                   const reflex::Thresholds& thresholds) {
  sim::Stepper stepper(scenario, car);
  return advance_to_trigger(stepper, thresholds) ? std::optional(stepper.time()) : std::nullopt;
}

std::optional<DecisionPoint> decision_point_at_trigger(const scenario::Scenario& scenario,
                                                       const manoeuvre::Car& car,
                                                       const reflex::Thresholds& thresholds) {
  sim::Stepper stepper(scenario, car);
  return advance_to_trigger(stepper, thresholds) ? std::optional(point_of(stepper, scenario, {}))
                                                 : std::nullopt;
}

world::Scene scene_at(const scenario::Scenario& scenario, const manoeuvre::Car& car, double time) {
  sim::Stepper stepper(scenario, car);
  advance_to(stepper, scenario, time);
  return stepper.scene();
}

DecisionPoint decision_point_at(const scenario::Scenario& scenario, const manoeuvre::Car& car,
                                double time, const scenario::Chance& chance) {
  sim::Stepper stepper(scenario, car, chance);
  advance_to(stepper, scenario, time);
  return point_of(stepper, scenario, chance);
}

std::vector<std::optional<encounter::Hindsights>> tried_from(
    const std::vector<std::optional<DecisionPoint>>& points, const manoeuvre::Car& car,
    const collision::HarmModel& harm, int threads) {
  std::vector<DecisionPoint> there;
  for (const std::optional<DecisionPoint>& point : points) {
    if (point) {
      there.push_back(*point);
    }
  }
  std::vector<encounter::Hindsights> tried = hindsights(there, car, harm, threads);
  std::vector<std::optional<encounter::Hindsights>> in_place(points.size());
  for (std::size_t i = 0, k = 0; i < points.size(); ++i) {
    if (points[i]) {
      in_place[i] = std::move(tried[k++]);
    }
  }
  return in_place;
}

}  // namespace saca::eval

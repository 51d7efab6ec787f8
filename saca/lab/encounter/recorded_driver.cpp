#include "saca/lab/encounter/recorded_driver.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/encounter/outcome_recorder.h"
#include "saca/lab/sim/stepper.h"
#include "saca/thinking/intent/motion.h"

namespace saca::encounter {
namespace {

/// Until when the ego and all who are there after `from` were recorded: beyond, it is a guess [s].
double recorded_until(const scenario::Scenario& scenario, const scenario::Recording& ego,
                      double from) {
  double until = ego.back().time;
  for (const scenario::ScenarioActor& actor : scenario.actors) {
    const auto* const recording = std::get_if<scenario::Recording>(&actor.motion);
    if (recording != nullptr && recording->back().time > from) {
      until = std::min(until, recording->back().time);
    }
  }
  return until;
}

/// What the driver did, look by look.
class DriverWatch {
 public:
  void look(const world::Scene& scene, RecordedDriver& driver) {
    constexpr std::size_t looked_back = 50;  // 0.5 s
    const world::LanePose at = world::to_lane(scene.road, scene.ego.X_WB);
    begin_ = begin_.value_or(at.d);
    if (std::abs(at.d - *begin_) > std::abs(driver.aside)) {
      driver.aside = at.d - *begin_;
    }
    speeds_.push_back(scene.ego.v_B.x);
    if (speeds_.size() > looked_back) {
      driver.braking = std::max(
          driver.braking, (speeds_.front() - speeds_.back()) / (looked_back * ClosedLoop::step));
      speeds_.pop_front();
    }
  }

 private:
  std::optional<double> begin_;
  std::deque<double> speeds_;
};

}  // namespace

std::optional<RecordedDriver> recorded_driver(const scenario::Scenario& scenario,
                                              const manoeuvre::Car& car,
                                              const collision::HarmModel& harm, double from) {
  const auto* const ego = std::get_if<scenario::Recording>(&scenario.ego);
  constexpr double worth_a_look = 0.1;  // [s]
  if (ego == nullptr || recorded_until(scenario, *ego, from) < from + worth_a_look) {
    return std::nullopt;
  }
  const double until = recorded_until(scenario, *ego, from);
  RecordedDriver driver;
  DriverWatch watch;
  sim::Stepper replay(scenario, car);
  OutcomeRecorder recorder(harm);
  while (!replay.over() && replay.time() <= until) {
    if (replay.time() >= from) {
      watch.look(replay.scene(), driver);
      if (recorder.look(replay)) {
        break;
      }
    }
    for (int k = 0; k < ClosedLoop::steps_per_look; ++k) {
      replay.advance({});
    }
  }
  driver.outcome = recorder.outcome();
  const auto& cast = recorder.scene().actors;
  driver.met.assign(cast.begin(), cast.end());
  return driver;
}

bool brakes(const RecordedDriver& driver) {
  return driver.braking >= intent::braking_mark;
}

int steers(const RecordedDriver& driver) {
  constexpr double far = 0.5;  // [m]
  return std::abs(driver.aside) < far ? 0 : driver.aside > 0.0 ? 1 : -1;
}

manoeuvre::PolicyId policy_of(const RecordedDriver& driver) {
  using manoeuvre::PolicyId;
  switch (steers(driver)) {
    case 1:
      return brakes(driver) ? PolicyId::es_b_left : PolicyId::aes_left;
    case -1:
      return brakes(driver) ? PolicyId::es_b_right : PolicyId::aes_right;
    default:
      return brakes(driver) ? PolicyId::aeb : PolicyId::no_intervention;
  }
}

}  // namespace saca::encounter

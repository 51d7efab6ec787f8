#include "saca/lab/sim/stepper.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/motion.h"

namespace saca::sim {
namespace {

constexpr double watched_after = 3.0;  // [s]: any driver's reaction and a firm stop from 20 m/s
const auto steps_per_traffic =
    static_cast<std::int64_t>(std::lround(Traffic::step / Stepper::step));

}  // namespace

Stepper::Stepper(const scenario::Scenario& scenario, const manoeuvre::Car& car,
                 const scenario::Chance& chance)
    : scenario_(scenario),
      car_(car),
      chance_(chance),
      real_car_(manoeuvre::real_car(car, chance.car)),
      grip_(std::min(1.2, scenario.grip * chance.car.grip)),
      traffic_(scenario, chance),
      seen_by_traffic_(scenario::ego_at(scenario, 0.0)) {}

void Stepper::take_the_wheel() {
  expects(!driven_, "the wheel is taken once");
  world::EgoState ego = scenario::ego_at(scenario_, time());
  ego.v_B.x = std::max(0.0, ego.v_B.x + chance_.car.speed);
  state_ = manoeuvre::rolling_state(real_car_, ego, grip_);
  driven_ = true;
  traffic_.let_followers_react();
}

void Stepper::advance(const vehicle::Command& command) {
  if (num_steps_ % steps_per_traffic == 0) {
    seen_by_traffic_ = ego();
  }
  if (driven_) {
    state_ = vehicle::step(real_car_, state_, command, grip_, step);
  }
  ++num_steps_;
  if (num_steps_ % steps_per_traffic == 0) {
    const world::EgoState& seen = seen_by_traffic_;
    traffic_.advance(seen.X_WB, rotated(seen.v_B, seen.X_WB.yaw), manoeuvre::footprint(real_car_));
  }
}

world::EgoState Stepper::ego() const {
  return driven_ ? manoeuvre::ego_state(state_) : scenario::ego_at(scenario_, time());
}

void Stepper::carry_on(StaticVector<world::Actor, world::max_actors>& actors) const {
  const double since = time() - traffic_.time();
  if (num_steps_ % steps_per_traffic == 0) {
    return;
  }
  for (world::Actor& actor : actors) {
    actor.X_WA.p = actor.X_WA.p + since * actor.v_W;
    actor.X_WA.yaw = wrap_angle(actor.X_WA.yaw + since * actor.yaw_rate);
  }
}

world::Scene Stepper::scene() const {
  return scene_of(traffic_.actors());
}

world::Scene Stepper::whole_scene() const {
  return scene_of(traffic_.cast());
}

world::Scene Stepper::scene_of(const StaticVector<world::Actor, world::max_actors>& actors) const {
  world::Scene scene{.time = time(),
                     .ego = ego(),
                     .ego_footprint = manoeuvre::footprint(real_car_),
                     .ego_mass = real_car_.mass,
                     .actors = actors,
                     .road = scenario_.road,
                     .grip = grip_};
  for (const world::Cue& cue : scenario_.cues) {
    scene.cues.push_back(cue);
  }
  carry_on(scene.actors);
  return scene;
}

world::Scene Stepper::perceive() {
  if (!perception_) {
    scenario::PerceptionModel model = scenario_.perception;
    model.grip_believed = scenario::believed_grip(scenario_);
    perception_.emplace(model, chance_.perception);
  }
  world::Scene truth = scene();
  truth.ego_mass = car_.mass;
  const auto ghosts = traffic_.ghosts();
  return perception_->look(truth, {ghosts.begin(), ghosts.size()});
}

manoeuvre::ParameterPerturbation Stepper::perturbation_from_now() const {
  manoeuvre::ParameterPerturbation perturbation = chance_.car;
  perturbation.grip = 1.0;
  perturbation.speed = 0.0;
  return perturbation;
}

collision::Others Stepper::others() const {
  return [traffic = traffic_, ego = manoeuvre::footprint(real_car_),
          last = scenario_.duration](const manoeuvre::EgoMotion& motion) {
    return traffic.against(motion, ego,
                           std::max(last, world::end_time(motion.track) + watched_after));
  };
}

}  // namespace saca::sim

#pragma once

// Scenarios by construction, for the tests of this module.

#include <filesystem>

#include "saca/lab/encounter/method.h"
#include "saca/lab/eval/forecast_score.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::eval {

inline collision::HarmModel shipped_harm() {
  return prepare::read_harm("data/harm.toml").value();
}

inline scenario::Scenario shipped_scenario(const std::string& name) {
  return scenario::load_scenario("scenarios/" + name + ".toml").value();
}

/// With the weights that are shipped.
inline WatchingModels shipped_models() {
  static const MixtureModel mixture = MixtureModel::read("models/places/model.safetensors").value();
  return {.mixture = &mixture, .seed = 1};
}

/// A wide straight road, dry, with a car standing `distance` ahead of the ego's front.
inline scenario::Scenario standing_car(double speed, double distance) {
  scenario::Scenario scenario;
  scenario.name = "standing_car";
  scenario.grip = 0.9;
  scenario.duration = 12.0;
  scenario.road.left_edge = 20.0;
  scenario.road.right_edge = -20.0;
  scenario.ego = scenario::EgoStart{{}, speed};
  scenario.actors.push_back({.kind = world::ActorKind::car,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1500.0,
                             .motion = scenario::Script{.start = {2.25 + distance + 2.25, 0.0, 0.0},
                                                        .behaviour = scenario::Behaviour::hold}});
  return scenario;
}

/// 22 m/s on a grip of 0.5 towards a standing car: braking at T1 needs 49 m and has 28.6 m, a
/// lane change to the left, which is free, some 25 m.
inline scenario::Scenario only_left_helps() {
  scenario::Scenario scenario = standing_car(22.0, 120.0);
  scenario.grip = 0.5;
  scenario.road.left_edge = 5.25;
  scenario.road.right_edge = -1.75;
  scenario.road.right_beyond = world::Beyond::barrier;
  return scenario;
}

/// 60 m ahead of an ego at 20 m/s a car drives as fast, and brakes at 6 m/s2 from 2 s on.
inline scenario::Scenario car_that_brakes() {
  scenario::Scenario scenario = standing_car(20.0, 60.0);
  scenario.duration = 6.0;
  scenario.actors[0].motion = scenario::Script{.start = {.s = 60.0},
                                               .speed = 20.0,
                                               .behaviour = scenario::Behaviour::brake,
                                               .acceleration = 6.0,
                                               .from = 2.0};
  return scenario;
}

/// A closed loop to be shown as the truth to methods that may not look at it.
struct UnseenTruth {
  manoeuvre::Car car = prepare::default_car();
  collision::HarmModel harm = shipped_harm();
  scenario::Scenario scenario = standing_car(20.0, 200.0);
  encounter::Stage stage{&scenario, &car, &harm, &intent::shipped_model(), {}, {}};
  encounter::ClosedLoop loop{stage};

  /// One step of a method in a scene, believing what is believed at sight.
  std::optional<encounter::Action> step(
      encounter::Method& method, const world::Scene& scene,
      const reflex::ActorSet& confirmed = reflex::all_actors) const {
    const intent::Beliefs beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
    return method.step({scene, beliefs, confirmed, true, false, loop});
  }
};

}  // namespace saca::eval

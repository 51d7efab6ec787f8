#pragma once

#include "saca/manoeuvre/ego.h"
#include "saca/sim/scenario.h"
#include "saca/vehicle/vehicle.h"
#include "saca/world/scene.h"
#include "tests/support/scenes.h"

namespace saca::loop {

/// A car at 20 m/s on a straight dry road, and a wreck in its lane: for tests.
/// @param distance  of the wreck's centre ahead of the centre of mass [m]
inline world::Scene wreck_ahead(const manoeuvre::Car& car, double distance) {
  world::Scene scene = test::ego_at(20.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {distance, 0.0}));
  return scene;
}

/// The same on a wet road, as a scenario: braking from 20 m/s at T1 is not enough.
/// @param distance  as above [m]
inline sim::Scenario wreck_on_wet_road(double distance = 90.0, double duration = 12.0) {
  sim::Scenario scenario{.name = "wreck",
                         .title = "A wreck",
                         .car = "compact_rwd_ev",
                         .grip = 0.5,
                         .duration = duration};
  scenario.road.left_edge = 5.25;
  scenario.road.right_edge = -5.25;
  scenario.ego = sim::EgoStart{.pose = {}, .speed = 20.0};
  scenario.actors.push_back(
      {.id = 1,
       .footprint = {.length = 4.5, .width = 1.8},
       .mass = 1'500.0,
       .motion = sim::Script{.start = {.s = distance}, .behaviour = sim::Behaviour::hold}});
  return scenario;
}

}  // namespace saca::loop

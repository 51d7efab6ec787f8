#pragma once

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "tests/support/scenes.h"

namespace saca::runtime {

/// A car at 20 m/s on a straight dry road, and a wreck in its lane: for tests.
/// @param distance  of the wreck's centre ahead of the centre of mass [m]
inline world::Scene wreck_ahead(const manoeuvre::Car& car, double distance) {
  world::Scene scene = test::ego_at(20.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {distance, 0.0}));
  return scene;
}

}  // namespace saca::runtime

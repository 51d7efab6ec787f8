#pragma once

#include "saca/manoeuvre/ego.h"
#include "saca/vehicle/vehicle.h"
#include "saca/world/scene.h"

namespace saca::loop {

/// A car at 20 m/s on a straight dry road, and a wreck in its lane: for tests.
/// @param distance  of the wreck's centre ahead of the centre of mass [m]
inline world::Scene wreck_ahead(const manoeuvre::Car& car, double distance) {
  world::Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  world::Actor wreck{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  wreck.X_WA.p = {distance, 0.0};
  scene.actors.push_back(wreck);
  return scene;
}

}  // namespace saca::loop

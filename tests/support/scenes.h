#pragma once

// Scenes for tests, of round numbers: a straight road along x_W, the ego at the origin in its lane.

#include <cmath>
#include <cstdint>

#include "saca/base/world/scene.h"

namespace saca::test {

/// Sizes of an ordinary car, and of one whose halves are whole metres, for tests that compute by
/// hand.
inline constexpr world::Footprint ego_body{.length = 4.7, .width = 1.9};
inline constexpr world::Footprint car_body{.length = 4.5, .width = 1.8};
inline constexpr world::Footprint whole_metres{.length = 4.0, .width = 2.0};

/// The ego at this speed [m/s] on a dry road, nobody else.
inline world::Scene ego_at(double speed, const world::Footprint& body = ego_body) {
  world::Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.ego_footprint = body;
  scene.ego_mass = 1'700.0;
  return scene;
}

/// The same without a body, on this grip: for what drives alone.
inline world::Scene ego_alone(double speed, double grip) {
  world::Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.grip = grip;
  return scene;
}

/// A car that points where it goes; one at rest points along x_W.
inline world::Actor car(std::uint8_t id, Vec2 p_W, Vec2 v_W = {}, Vec2 a_W = {},
                        const world::Footprint& body = car_body) {
  world::Actor actor{.id = id, .footprint = body, .mass = 1'500.0};
  actor.X_WA = {p_W, norm(v_W) > 0.0 ? std::atan2(v_W.y, v_W.x) : 0.0};
  actor.v_W = v_W;
  actor.a_W = a_W;
  return actor;
}

/// A car of 4 m by 2 m.
inline world::Actor block(std::uint8_t id, Vec2 p_W, Vec2 v_W = {}) {
  return car(id, p_W, v_W, {}, whole_metres);
}

}  // namespace saca::test

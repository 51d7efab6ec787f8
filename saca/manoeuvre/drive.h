#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/manoeuvre/plan.h"
#include "saca/vehicle/vehicle.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::manoeuvre {

/// Why a plan cannot be driven from here; nullopt when it can.
///
/// Domain: policies 0, 1, 2, 3, 4, 7; 5 to 25 m/s (0 and 7 from rest); grip 0.3 to 1.0; lanes 2 to
/// 6 m wide; for a lane change a bend that takes at most half of the grip.
[[nodiscard]] std::optional<std::string> refusal(const Plan& plan, const world::Scene& scene);

/// How the ego moves: poses of B at equal steps and, with them, velocity and turning.
struct EgoMotion {
  world::Track track;            ///< X_WB
  std::vector<Vec2> v_B;         ///< over ground [m/s]   (one per pose)
  std::vector<double> yaw_rate;  ///< [rad/s]             (one per pose)
  bool ended = false;  ///< at rest, or lane change recovered; false when the horizon came first
};

/// Drives `plan` from the scene's ego state with the vehicle model and the closed-loop controller.
///
/// @param grip     true friction coefficient; the controller knows only scene.grip
/// @param horizon  longest time [s]
/// @return         poses every 10 ms from scene.time, the model integrated at 1 ms
/// @throws ContractViolation  if refusal(plan, scene) has a reason
[[nodiscard]] EgoMotion drive(const vehicle::Vehicle& car, const Plan& plan,
                              const world::Scene& scene, double grip, double horizon);

}  // namespace saca::manoeuvre

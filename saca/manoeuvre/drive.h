#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/plan.h"
#include "saca/manoeuvre/unknown.h"
#include "saca/vehicle/vehicle.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::manoeuvre {

/// Why a plan cannot be driven from here; nullopt when it can.
///
/// Domain: lane changes at 5 to 25 m/s, drifts at the speeds of the car's DriftDomain,
/// grip 0.2 to 1.0, lanes 2 to 6 m wide, in bends that take at most half of the grip (of a drift:
/// 0.3). Braking and
/// no intervention are possible from any finite state: they are what is left when all else is
/// refused. Outside the domain their figures are not claimed.
[[nodiscard]] std::optional<std::string> refusal(const Car& car, const Plan& plan,
                                                 const world::Scene& scene);

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
/// @param unknown  what else the controller does not know (see `Ride`)
/// @return         poses every 10 ms from scene.time, the model integrated at 1 ms
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
[[nodiscard]] EgoMotion drive(const Car& car, const Plan& plan, const world::Scene& scene,
                              double grip, double horizon, const Unknown& unknown = {});

}  // namespace saca::manoeuvre

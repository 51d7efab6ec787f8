#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// Why a plan cannot be driven.
enum class Refusal : std::uint8_t {
  unknown_policy,
  target_speed,  ///< missing, out of range, or of a policy that has none
  grip,          ///< believed
  ego_state,     ///< not finite
  slippery,      ///< no speed at which this car drifts on that grip
  speed,
  road,  ///< not finite, or a lane too narrow or too wide
  bend,
  strength,  ///< out of range, or of a policy that has none
};

/// Why a plan cannot be driven from here; nullopt when it can. For the reflex plane: allocates
/// nothing.
///
/// Domain: lane changes at 5 to 25 m/s, drifts at the speeds of the car's DriftDomain,
/// grip 0.2 to 1.0, lanes 2 to 6 m wide, in bends that take at most half of the grip (of a drift:
/// 0.3) and leave a lane change a twentieth (share_of_swerve). Braking and no intervention are
/// possible from any finite state: they are what is left when all else is
/// refused. Outside the domain their figures are not claimed.
[[nodiscard]] std::optional<Refusal> why_refused(const Car& car, const Plan& plan,
                                                 const world::Scene& scene) noexcept;

/// What stands in the way, in a word or two.
[[nodiscard]] std::string_view name(Refusal why);

/// Why, in words and with the numbers.
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
/// @param perturbation  what else the controller does not know (see `Ride`)
/// @return         poses every 10 ms from scene.time, the model integrated at 1 ms
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
[[nodiscard]] EgoMotion drive(const Car& car, const Plan& plan, const world::Scene& scene,
                              double grip, double horizon,
                              const ParameterPerturbation& perturbation = {});

}  // namespace saca::manoeuvre

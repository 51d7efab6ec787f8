#pragma once

#include <type_traits>

#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/drift.h"
#include "saca/onboard/manoeuvre/lane_shift.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/vehicle/abs.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// What a controller remembers between two calls. Set to `begin(...)` when the manoeuvre starts.
struct ControllerState {
  Plan plan;           ///< what is driven
  LaneShift shift;     ///< of the controlled point, which lies ahead of the centre of mass
  double end_d = 0.0;  ///< lane offset where the shift ends [m]
  double time = 0.0;   ///< since the start [s]
  double speed = 0.0;  ///< to keep [m/s]: the initial one, or the plan's target
  vehicle::AbsState abs;
  double recovered_for = 0.0;  ///< how long lane, direction and speed have been right [s]
  DriftState drift;
};
static_assert(std::is_trivially_copyable_v<ControllerState>);

/// A manoeuvre's controller at its start.
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
[[nodiscard]] ControllerState begin(const Car& car, const Plan& plan, const world::Scene& scene);

/// What to tell the car now. Called at every step of a manoeuvre, whose `begin` gave `memory`.
///
/// @param grip  estimate of the friction coefficient [-], in [0.2, 1.0]; may be wrong
/// @param dt    since the last call [s], > 0
///
/// Path: the force of the front wheels moves the point that rear forces cannot accelerate (the
/// centre of percussion) along a LaneShift; an inverse tyre model turns force into a steering
/// angle. Speed: anti-lock braking with what the path leaves of the grip,
/// at most the plan's strength of it, or the motor. Policies 5
/// and 6 have no path: see DriftLaw.
/// Allocates nothing, never throws. A motion, steering angle or grip that is not finite gets full
/// braking straight ahead; a wheel whose speed or torque is not finite is taken to roll freely.
///
/// Source of the point: K. Kritayakirana, J. C. Gerdes, Using the centre of percussion to design a
/// steering controller for an autonomous race car, Vehicle System Dynamics 50 (2012).
[[nodiscard]] vehicle::Command control(const Car& car, const world::Road& road, double grip,
                                       const vehicle::VehicleState& state, ControllerState& memory,
                                       double dt) noexcept;

/// How much of the grip the bend itself takes at this speed [-].
[[nodiscard]] double share_of_bend(const world::Scene& scene) noexcept;

/// How much of the grip a lane change may take that begins here: less where it is fast, or a bend
/// takes some [-]. Where little is left, it is refused (why_refused).
[[nodiscard]] double share_of_swerve(const Car& car, const Plan& plan,
                                     const world::Scene& scene) noexcept;

/// Whether its safe end is at rest, where it is held: of 0, 5 and 6, and of 3 and 4 with target 0.
[[nodiscard]] bool ends_at_rest(const ControllerState& memory) noexcept;

/// Whether the manoeuvre has reached its safe end: at rest for 0, 5 and 6 (3, 4 with target 0);
/// for the others with a lane change: lane offset within 0.2 m, direction within 2 degrees and
/// speed within 1 m/s of the wanted ones for 0.2 s, from where `control` keeps the lane at that
/// speed. No intervention never ends.
[[nodiscard]] bool finished(const vehicle::VehicleState& state,
                            const ControllerState& memory) noexcept;

}  // namespace saca::manoeuvre

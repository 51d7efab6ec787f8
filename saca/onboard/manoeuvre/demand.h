#pragma once

#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/vehicle/abs.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

/// An acceleration that a car is asked for, in shares of what the road's grip gives: within the
/// unit disc. The inputs of a car that follows no plan; those of a point mass (danger/avoidance.h),
/// where the tyres can do what is asked.
struct Demand {
  double along = 0.0;   ///< forward [-]
  double across = 0.0;  ///< to the left [-]
};

/// Moved to the edge of the unit disc if it lies beyond.
[[nodiscard]] Demand admissible(const Demand& demand) noexcept;

/// What to tell the car now so that it comes to the demanded acceleration as fast as it can.
///
/// Across: the front wheels push the centre of percussion, by the steering angle of `control`
/// (controller.h), whose guard keeps the rear from sliding away. Along: anti-lock braking, or the
/// motor, up to what the driven axle's load carries beside the steering. Both tyres and actuators
/// follow late.
/// @param demand  admissible
/// @param grip    estimate of the friction coefficient [-], in [0.2, 1.0]; may be wrong
/// @param abs     `begin_abs` when the first demand is begun
/// @param dt      since the last call [s], > 0
/// Allocates nothing.
[[nodiscard]] vehicle::Command command_for(const Car& car, const Demand& demand, double grip,
                                           const vehicle::VehicleState& state,
                                           vehicle::AbsState& abs, double dt) noexcept;

}  // namespace saca::manoeuvre

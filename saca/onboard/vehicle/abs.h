#pragma once

#include "saca/onboard/vehicle/vehicle.h"

namespace saca::vehicle {

/// Torques of an ideal anti-lock brake: it knows the friction and the load of every wheel and holds
/// each tyre just short of its peak. For checks against references; no real car can have it.
/// @param grip  the true friction coefficient [-]
/// @return      [N m], each >= 0
[[nodiscard]] PerWheel ideal_brakes(const Vehicle& car, const VehicleState& state,
                                    double grip) noexcept;

/// What the deployed anti-lock brake remembers between two calls.
struct AbsState {
  double speed = 0.0;          ///< its estimate of the car's speed ahead [m/s]
  PerWheel share{1, 1, 1, 1};  ///< of the torque that its model asks for [-], learnt from slip
  PerWheel slip{};             ///< slip estimate of the last call [-]
};

/// @param speed  the car's speed ahead, as its sensors know it [m/s]
[[nodiscard]] AbsState begin_abs(double speed) noexcept;

/// Torques of the deployed anti-lock brake for a wanted deceleration. It knows neither friction nor
/// load exactly: it starts from the grip estimate and from loads by the measured acceleration, then
/// corrects each wheel by that wheel's estimated slip.
///
/// @param deceleration  wanted [m/s^2], >= 0; more than the road gives asks for all of it
/// @param grip          estimate of the friction coefficient [-], > 0
/// @param dt            since the last call [s], > 0
/// @return              [N m], each >= 0
///
/// Measures wheel speeds, acceleration, yaw rate and steering angle; the speed over ground is
/// integrated from acceleration while the wheels brake. Allocates nothing.
[[nodiscard]] PerWheel deployed_brakes(const Vehicle& car, const VehicleState& state,
                                       double deceleration, double grip, double dt,
                                       AbsState& abs) noexcept;

}  // namespace saca::vehicle

#pragma once

#include "saca/base/core/vec2.h"
#include "saca/onboard/manoeuvre/tuning.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::manoeuvre {

// The T-drift (policies 5 and 6): the car slides to a stop across its lane. One feedback law from
// begin to rest, by measured heading, turning rate, speed and acceleration; no clock, no phases.
//
// The turning rate wanted is the one that brings heading and speed to their ends together:
// r* = turning (pi/2 - heading) a / v, with a the deceleration of a slide. What is missing of it
// is a demand u in [-1, 1], that all actuators serve at once. While u > 0 the front wheels steer
// in, the brakes of the outer side and of the front axle open, so that the inner side holds and
// the front pulls the nose round, and the motor helps the brakes or the driven wheels. While u < 0
// the brakes of the inner side and of the rear axle open. At u = 0 all four wheels are locked and
// the car slides straight on; so it ends, too.

/// What is known of the car's motion, by its sensors.
struct DriftMotion {
  double heading = 0.0;   ///< against the lane [rad]
  Vec2 v_B;               ///< over ground [m/s]
  double yaw_rate = 0.0;  ///< [rad/s]
  Vec2 a_B;               ///< [m/s^2]
};

/// What the law remembers between two calls: the last turning rate and its smoothed growth, both
/// positive towards the side that is wanted.
struct DriftState {
  double yaw_rate = 0.0;          ///< [rad/s]
  double yaw_acceleration = 0.0;  ///< [rad/s^2]
};

/// What to tell the car, to end facing left (heading pi/2).
/// @param grip  estimate of the friction coefficient [-], > 0
/// @param dt    since the last call [s], > 0
/// Allocates nothing, never throws.
[[nodiscard]] vehicle::Command drift_left(const vehicle::Vehicle& car, const DriftLaw& law,
                                          double grip, const DriftMotion& motion, double dt,
                                          DriftState& memory) noexcept;

/// The mirror image: to end facing right.
[[nodiscard]] vehicle::Command drift_right(const vehicle::Vehicle& car, const DriftLaw& law,
                                           double grip, const DriftMotion& motion, double dt,
                                           DriftState& memory) noexcept;

}  // namespace saca::manoeuvre

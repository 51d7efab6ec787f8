#pragma once

#include <array>
#include <cstddef>

#include "saca/base/core/pose.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::learned_danger {

/// How long every input is held, and how far looks are apart [s].
constexpr double look_step = 0.1;

/// Where the ego is between two looks: every 20 ms, the last at the look itself.
constexpr std::size_t poses_per_look = 5;
using PosesOnTheWay = std::array<Pose, poses_per_look>;

/// The ego at one look: all that its own motion depends on, as far as a car can measure it. What
/// brakes and motor were told within the last milliseconds is left out.
struct Ego {
  Pose X_WB;              ///< B at the centre of mass
  Vec2 v_B;               ///< over ground [m/s]
  double yaw_rate = 0.0;  ///< [rad/s]
  Vec2 a_B;               ///< of the centre of mass [m/s^2]
  double steering = 0.0;  ///< of the road wheels [rad]
  double braking = 0.0;   ///< brake torques at the wheels, as a deceleration of the car [m/s^2]
  double driving = 0.0;   ///< the motor's torque likewise [m/s^2]
};

/// Where its centre of mass moves: its yaw where it stands [rad], not wrapped.
[[nodiscard]] double course(const Ego& ego);

[[nodiscard]] Ego ego_of(const vehicle::Vehicle& car, const vehicle::VehicleState& state);

/// A car that is driven by one demand after another. Grip is known to whoever drives.
class DemandDrivenCar {
 public:
  /// @param state  at the start
  /// @param grip   [-], in [0.2, 1.0]
  DemandDrivenCar(const manoeuvre::Car& car, const vehicle::VehicleState& state, double grip);

  /// Holds the demand, moved onto the unit disc, for `look_step`. Allocates nothing.
  PosesOnTheWay hold(const manoeuvre::Demand& demand);

  [[nodiscard]] const vehicle::VehicleState& state() const { return state_; }
  [[nodiscard]] Ego ego() const { return ego_of(*car_, state_); }

 private:
  const manoeuvre::Car* car_;
  vehicle::VehicleState state_;
  double grip_;
  vehicle::AbsState abs_;
};

}  // namespace saca::learned_danger

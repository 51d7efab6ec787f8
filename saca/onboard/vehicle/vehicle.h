#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "saca/base/core/pose.h"
#include "saca/onboard/vehicle/tyre.h"

namespace saca::vehicle {

/// [m/s^2]; standard gravity.
constexpr double gravity = 9.80665;

/// [kg/m^3]; standard atmosphere at sea level, ISO 2533.
constexpr double air_density = 1.225;

/// Index of a wheel in every array of four.
enum Wheel : std::uint8_t { front_left, front_right, rear_left, rear_right };
constexpr std::size_t num_wheels = 4;

/// A number for each wheel, in the order of `Wheel`.
using PerWheel = std::array<double, num_wheels>;

/// A car's parameters. There are no default numbers: they come from data/vehicles/.
struct Vehicle {
  double mass;              ///< [kg], > 0
  double yaw_inertia;       ///< about the vertical through the centre of mass [kg m^2], > 0
  double cg_to_front_axle;  ///< centre of mass to front axle [m], > 0
  double cg_to_rear_axle;   ///< centre of mass to rear axle [m], > 0
  double track_width;       ///< distance of left and right wheels [m], > 0
  double cg_height;         ///< of the centre of mass above the road [m], > 0
  double front_roll_stiffness_share;  ///< share of lateral load transfer carried in front [-], in
                                      ///< [0, 1]
  double load_transfer_lag;           ///< time constant [s], > 0
  double drag_area;                   ///< drag coefficient times frontal area [m^2], >= 0
  double wheel_radius;                ///< [m], > 0
  double front_wheel_inertia;         ///< of one wheel about its axle [kg m^2], > 0
  double rear_wheel_inertia;  ///< likewise; each with its part of the drive train [kg m^2], > 0
  Tyre tyre;                  ///< all four
  double steering_lag;        ///< time constant [s], > 0
  double steering_rate;       ///< largest, of the road wheels [rad/s], > 0
  double steering_limit;      ///< largest angle of the road wheels [rad], in (0, pi/2)
  double brake_dead_time;     ///< [s], in [0, 0.06]
  double brake_lag;           ///< time constant of the build-up after the dead time [s], > 0
  double brake_limit;         ///< largest torque on one wheel [N m], > 0
  double motor_limit;         ///< largest torque of the motor, either way [N m], >= 0
  double motor_front_share;   ///< of its torque, at the front axle: 0 rear-driven, 1 front [-]
  double motor_lag;           ///< time constant [s], > 0
  double body_length;         ///< [m], > 0
  double body_width;          ///< [m], > 0
  double front_end;           ///< front bumper ahead of the centre of mass [m], > 0
};

/// What the car is told to do, held for one step.
struct Command {
  double steering = 0.0;      ///< angle of the road wheels [rad], > 0 to the left
  PerWheel brake_torque{};    ///< [N m], each >= 0
  double motor_torque = 0.0;  ///< of all driven wheels; those of an axle share equally [N m]
};

/// Brake commands on their way: what was commanded in the last milliseconds. The brakes' bus runs
/// at 1 kHz, so a command waits in slots of 1 ms.
struct BrakeLine {
  static constexpr double slot = 1e-3;  ///< [s]
  static constexpr std::size_t num_slots = 64;
  std::array<PerWheel, num_slots> torque{};  ///< ring [N m]
  std::uint8_t next = 0;                     ///< the slot to be written next
  double since = slot;                       ///< since the last slot was written [s]
};

/// Everything that changes while the car moves. Trivially copyable: two equal states stay equal,
/// byte for byte, under equal commands.
struct VehicleState {
  Pose X_WB;                  ///< B at the centre of mass
  Vec2 v_B;                   ///< over ground [m/s]
  double yaw_rate = 0.0;      ///< [rad/s]
  PerWheel wheel_speed{};     ///< > 0 rolls forward [rad/s]
  double steering = 0.0;      ///< of the road wheels, between the two [rad]
  PerWheel brake_torque{};    ///< at the wheels [N m], >= 0
  double motor_torque = 0.0;  ///< of all driven wheels [N m]
  Vec2 transfer_a_B;          ///< acceleration that the wheel loads answer to, lagged [m/s^2]
  Vec2 a_B;                   ///< of the centre of mass at the start of the last step [m/s^2]
  BrakeLine brake_line;
};
static_assert(std::is_trivially_copyable_v<VehicleState>);

/// Where a wheel touches the road.
struct WheelContact {
  double load = 0.0;        ///< [N], >= 0
  double angle = 0.0;       ///< of the wheel against the body [rad]
  Vec2 F_T;                 ///< force of the road on the wheel, expressed in T [N]
  double slip = 0.0;        ///< size of the sliding velocity over speed [-], >= 0
  double peak_force = 0.0;  ///< largest force at this load [N]
};
using WheelContacts = std::array<WheelContact, num_wheels>;

/// Below this speed [m/s] a car whose brakes hold more than its motor pulls stands still: the next
/// step sets all its velocities to zero and leaves them there until the brakes let go.
constexpr double hold_speed = 0.05;

/// Where a wheel's centre lies from the centre of mass, expressed in B [m].
[[nodiscard]] Vec2 wheel_position(const Vehicle& car, std::size_t wheel);

/// Share of the motor's torque at a wheel, in [0, 0.5].
[[nodiscard]] double motor_share(const Vehicle& car, std::size_t wheel);

/// Load on each wheel under a lasting acceleration of the body [N], each >= 0; together the weight.
/// An axle whose inner wheel has lifted leaves the rest of the roll to the other axle.
[[nodiscard]] PerWheel wheel_loads(const Vehicle& car, Vec2 a_B);

/// The four contacts of a state.
/// @param grip  friction coefficient of the road [-], in (0, 1.2]; one, or one under each wheel
[[nodiscard]] WheelContacts contacts(const Vehicle& car, const VehicleState& state, double grip);
[[nodiscard]] WheelContacts contacts(const Vehicle& car, const VehicleState& state,
                                     const PerWheel& grip);

/// Kinetic energy of the body and its wheels [J].
[[nodiscard]] double kinetic_energy(const Vehicle& car, const VehicleState& state);

/// At rest, all of it: nothing turns, nothing moves.
[[nodiscard]] bool at_rest(const VehicleState& state);

/// With which predictions and simulated drives are integrated [s].
constexpr double usual_step = 1e-3;

/// The longest step [s] that resolves this car's fastest motion, the spin of a wheel at low speed;
/// at most 2 ms. A longer one would not be wrong but unstable.
[[nodiscard]] double longest_step(const Vehicle& car);

/// The state `dt` later under a held command.
///
/// @param grip  friction coefficient of the road [-], in (0, 1.2]; one, or one under each wheel
/// @param dt    [s], in (0, longest_step(car)]
/// @throws ContractViolation  if anything is not finite or outside its range
///
/// Planar double track on a level road: four wheel speeds, lagged load transfer, air drag,
/// Ackermann steering, actuators with lag, rate, limit and dead time. Commands beyond a limit act
/// at the limit. Classical Runge-Kutta of fourth order. A wheel that its brake would stop within 1
/// ms, and whose brake holds more than the road turns, is locked; a car that its brakes hold below
/// `hold_speed` is at rest. Allocates nothing.
[[nodiscard]] VehicleState step(const Vehicle& car, const VehicleState& state,
                                const Command& command, double grip, double dt);
[[nodiscard]] VehicleState step(const Vehicle& car, const VehicleState& state,
                                const Command& command, const PerWheel& grip, double dt);

}  // namespace saca::vehicle

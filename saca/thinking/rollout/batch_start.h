#pragma once

#include <cmath>
#include <numbers>

#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/manoeuvre/ride.h"
#include "saca/thinking/rollout/batch_lane.h"

/// How a drive is written down for the batch's kernels. Not part of the library's interface.
namespace saca::rollout::lanes {

template <class T>
Divisor<T> divisor(double value) {
  return {static_cast<T>(value), static_cast<T>(1.0 / value)};
}

template <class T>
SwerveLane<T> swerve_lane(const manoeuvre::SwerveLaw& law) {
  const auto t = [](double value) { return static_cast<T>(value); };
  return {t(law.lag), t(law.frequency), t(law.damping), t(law.guard_from),
          divisor<T>(law.guard_width)};
}

template <class T>
DriftLane<T> drift_lane(const manoeuvre::DriftLaw& law) {
  const auto t = [](double value) { return static_cast<T>(value); };
  return {.turning = t(law.turning),
          .most_turning = t(law.most_turning),
          .gain = t(law.gain),
          .lead = t(law.lead),
          .front_release = t(law.front_release),
          .rear_release = t(law.rear_release),
          .outer_release = t(law.outer_release),
          .motor_share = t(law.motor_share),
          .steering = t(law.steering),
          .slide_share = t(law.slide_share),
          .lock_speed = t(law.lock_speed)};
}

/// @param grip  as the controller knows it
template <class T>
CarLane<T> car_lane(const manoeuvre::Car& car, double grip) {
  const auto t = [](double value) { return static_cast<T>(value); };
  return {.mass = divisor<T>(car.mass),
          .yaw_inertia = divisor<T>(car.yaw_inertia),
          .wheelbase = divisor<T>(vehicle::equations::wheelbase(car)),
          .track_width = divisor<T>(car.track_width),
          .wheel_radius = divisor<T>(car.wheel_radius),
          .front_wheel_inertia = divisor<T>(car.front_wheel_inertia),
          .rear_wheel_inertia = divisor<T>(car.rear_wheel_inertia),
          .load_transfer_lag = divisor<T>(car.load_transfer_lag),
          .steering_lag = divisor<T>(car.steering_lag),
          .brake_lag = divisor<T>(car.brake_lag),
          .motor_lag = divisor<T>(car.motor_lag),
          .peak_slip = divisor<T>(manoeuvre::equations::peak_slip(car, grip)),
          .cg_to_front_axle = t(car.cg_to_front_axle),
          .cg_to_rear_axle = t(car.cg_to_rear_axle),
          .half_track = t(vehicle::equations::half_track(car)),
          .cg_height = t(car.cg_height),
          .front_roll_stiffness_share = t(car.front_roll_stiffness_share),
          .front_weight = t(vehicle::equations::front_weight(car)),
          .rear_weight = t(vehicle::equations::rear_weight(car)),
          .air_drag = t(vehicle::equations::air_drag(car)),
          .steering_rate = t(car.steering_rate),
          .steering_limit = t(car.steering_limit),
          .brake_limit = t(car.brake_limit),
          .motor_limit = t(car.motor_limit),
          .front_motor_share = t(vehicle::motor_share(car, vehicle::front_left)),
          .rear_motor_share = t(vehicle::motor_share(car, vehicle::rear_left)),
          .front_rolls = t(vehicle::equations::front_rolls(car) ? 1.0 : 0.0),
          .percussion_arm = t(manoeuvre::equations::percussion_arm(car)),
          .driven_load = t(manoeuvre::equations::driven_load(car)),
          .tyre = {t(car.tyre.stiffness), divisor<T>(car.tyre.shape), t(car.tyre.load_sensitivity),
                   t(vehicle::equations::per_newton(car.tyre)), t(2.0 * car.tyre.shape),
                   t(car.tyre.stiffness / car.tyre.shape)},
          .tuning = {swerve_lane<T>(car.tuning.swerve), drift_lane<T>(car.tuning.drift)}};
}

template <class T>
ShiftLane<T> shift_lane(const manoeuvre::LaneShift& shift) {
  const auto t = [](double value) { return static_cast<T>(value); };
  const double swing = shift.ramp + shift.first;
  const double last = swing + 2.0 * shift.ramp + shift.second;
  return {.start_d = t(shift.start_d),
          .start_v = t(shift.start_v),
          .jerk = t(manoeuvre::equations::jerk(shift)),
          .change = {t(shift.ramp), t(swing), t(swing + 2.0 * shift.ramp), t(last)},
          .end = t(manoeuvre::duration(shift)),
          .end_d = t(at(shift, manoeuvre::duration(shift)).d)};
}

template <class T>
MemoryLane<T> memory_lane(const manoeuvre::ControllerState& memory) {
  const auto t = [](double value) { return static_cast<T>(value); };
  return {.shift = shift_lane<T>(memory.shift),
          .end_d = t(memory.end_d),
          .time = t(memory.time),
          .speed = t(memory.speed),
          .abs = {t(memory.abs.speed),
                  {t(1), t(1), t(1), t(1)},
                  {t(0), t(0), t(0), t(0)},
                  {t(0), t(0), t(0), t(0)}},
          .recovered_for = t(memory.recovered_for),
          .drift = {t(memory.drift.yaw_rate), t(memory.drift.yaw_acceleration), t(0)}};
}

inline Kind kind_of(manoeuvre::PolicyId policy) {
  return manoeuvre::drifts(policy) ? Kind::drifts
         : policy == manoeuvre::PolicyId::aeb || manoeuvre::brakes_to_speed(policy)
             ? Kind::brakes
             : Kind::keeps_speed;
}

/// The brakes' dead time in steps.
struct Delay {
  std::size_t whole;
  double share;  ///< of one more, in [0, 1)
};
inline Delay delay_of(const vehicle::Vehicle& car, Kind kind) {
  const double slots = std::round(car.brake_dead_time / vehicle::BrakeLine::slot);
  const double steps = slots * vehicle::BrakeLine::slot / step_of(kind);
  const double whole = std::floor(steps + 1e-9);
  return {static_cast<std::size_t>(whole), std::max(0.0, steps - whole)};
}

template <class T>
FixedLane<T> fixed_lane(const manoeuvre::Car& car, const manoeuvre::Ride& ride,
                        const manoeuvre::Plan& plan, double known_grip, double curvature) {
  const Kind kind = kind_of(plan.policy);
  const auto t = [](double value) { return static_cast<T>(value); };
  manoeuvre::Car real = car;
  static_cast<vehicle::Vehicle&>(real) = ride.real();
  return {.real = car_lane<T>(real, known_grip),
          .known = car_lane<T>(car, known_grip),
          .grip = t(ride.grip()),
          .known_grip = t(known_grip),
          .curvature = t(curvature),
          .rest = t(plan.policy == manoeuvre::PolicyId::aeb ? 1.0 : 0.0),
          .slower = t(manoeuvre::brakes_to_speed(plan.policy) ? 1.0 : 0.0),
          .strength = t(manoeuvre::strength_of(plan)),
          .side = t(manoeuvre::side(plan.policy)),
          .delay_share = t(delay_of(ride.real(), kind).share)};
}

/// @param X_LB  the car in the frame that the lanes move in
template <class T>
MovingLane<T> moving_lane(const manoeuvre::Ride& ride, const Pose& X_LB,
                          const manoeuvre::ControllerState& memory) {
  using F = vehicle::equations::StateVector<T>;
  const auto t = [](double value) { return static_cast<T>(value); };
  const vehicle::VehicleState& state = ride.state();
  MovingLane<T> lane{};
  lane.state_vector[F::x] = t(X_LB.p.x);
  lane.state_vector[F::y] = t(X_LB.p.y);
  lane.state_vector[F::yaw] = t(X_LB.yaw);
  lane.state_vector[F::vx] = t(state.v_B.x);
  lane.state_vector[F::vy] = t(state.v_B.y);
  lane.state_vector[F::yaw_rate] = t(state.yaw_rate);
  std::array<T, vehicle::num_wheels> torque{};
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    lane.state_vector[F::wheel + i] = t(state.wheel_speed[i]);
    torque[i] = t(state.brake_torque[i]);
    lane.state_vector[F::brake + i] = torque[i];
  }
  lane.state_vector[F::steering] = t(state.steering);
  lane.state_vector[F::motor] = t(state.motor_torque);
  lane.state_vector[F::ax] = t(state.transfer_a_B.x);
  lane.state_vector[F::ay] = t(state.transfer_a_B.y);
  lane.ax = t(state.a_B.x);
  lane.ay = t(state.a_B.y);
  lane.first = t(1.0);
  lane.memory = memory_lane<T>(memory);
  lane.brake_line.fill(torque);
  return lane;
}

}  // namespace saca::rollout::lanes

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include "saca/base/core/number.h"
#include "saca/base/core/units.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/drift.h"
#include "saca/onboard/manoeuvre/lane_shift.h"
#include "saca/onboard/vehicle/abs_equations.h"

/// The controllers' equations, for any number type `T` (`core/number.h`): `controller.h`, `drift.h`
/// and `lane_shift.h` have them for one car in `double`, and say what they mean. `Car`, `State`,
/// `Shift`, `Memory` and `Command` are those of one car, or many side by side with fields of the
/// same names and the functions of `Car` and `LaneShift` below.
namespace saca::manoeuvre::equations {

using namespace number;
using vehicle::front_left;
using vehicle::front_right;
using vehicle::gravity;
using vehicle::rear_left;
using vehicle::rear_right;
using vehicle::equations::Pair;
using vehicle::equations::Turn;
using vehicle::equations::wheelbase;
using vehicle::equations::Wheelwise;

// Numbers that hold for any car; those of a car are in its tuning.
constexpr double front_limit = 0.97;     // share of the front tyres' peak that steering may ask for
constexpr double combined_share = 0.92;  // of the grip, for braking and steering together
constexpr double least_stop_share =
    0.6;                       // of the grip, that a stop brakes with whatever the path asks
constexpr double crawl = 1.5;  // [m/s] below it steering fades out

// Slower than this the car is not kept rolling but stopped [m/s].
constexpr double least_kept_speed = 0.5;

// How far ahead of the centre of mass rear forces do not accelerate the body sideways [m].
inline double percussion_arm(const Car& car) noexcept {
  return car.yaw_inertia / (car.mass * car.cg_to_rear_axle);
}

// What the driven axles together can take to the road, shared as the motor shares it [N].
inline double driven_load(const Car& car) noexcept {
  const double per_metre = car.mass * gravity / (car.cg_to_front_axle + car.cg_to_rear_axle);
  const double front_share = car.motor_front_share;
  const double by_front = per_metre * car.cg_to_rear_axle / std::max(front_share, 1e-9);
  const double by_rear = per_metre * car.cg_to_front_axle / std::max(1.0 - front_share, 1e-9);
  return std::min(by_front, by_rear);
}

// Slip at which the tyres give most.
inline double peak_slip(const Car& car, double grip) noexcept {
  return vehicle::slip_for(car.tyre, grip, 1.0);
}

inline double jerk(const LaneShift& shift) noexcept {
  return shift.amplitude / shift.ramp;
}

template <class T>
struct Lateral {
  T d;
  T v;
  T a;
};

template <class T>
inline Lateral<T> after(const Lateral<T>& now, const T& jerk, const T& t) noexcept {
  return {.d = now.d + t * (now.v + t * (now.a / 2.0 + t * jerk / 6.0)),
          .v = now.v + t * (now.a + t * jerk / 2.0),
          .a = now.a + t * jerk};
}

template <class T, class Shift>
inline Lateral<T> at(const Shift& shift, T time) noexcept {
  Lateral<T> now{.d = shift.start_d + min(time, 0.0) * shift.start_v, .v = shift.start_v, .a = 0.0};
  const T steepness = jerk(shift);
  const T ramp = shift.ramp;
  const T swing = 2.0 * shift.ramp;
  const auto stretch = [&](const T& length, const T& growth) {  // one of constant jerk
    now = after(now, growth, clamp(time, 0.0, length));
    time = time - length;
    return all(time <= 0.0);
  };
  if (all(time <= 0.0) || stretch(ramp, steepness) || stretch(shift.first, 0.0) ||
      stretch(swing, -steepness) || stretch(shift.second, 0.0) || stretch(ramp, steepness)) {
    return now;
  }
  const auto over = time > 0.0;
  return {.d = now.d, .v = select(over, 0.0, now.v), .a = select(over, 0.0, now.a)};
}

// The controlled point against the lane.
template <class T>
struct PathPoint {
  T d;           // [m]
  T heading;     // of the car against the lane there [rad]
  Turn<T> turn;  // by that
  Pair<T> v_L;   // of the point [m/s]
};

// @param arm  from the centre of mass to the point [m]
template <class T, class Velocity>
inline PathPoint<T> path_point(const T& d, const T& heading, const T& arm, const Velocity& v_B,
                               const T& yaw_rate) {
  const Turn<T> turn = vehicle::equations::turn_by<T>(heading);
  const T vy = v_B.y + yaw_rate * arm;
  return {d,
          heading,
          turn,
          {turn.cosine * v_B.x - turn.sine * vy, turn.sine * v_B.x + turn.cosine * vy}};
}

// Deceleration that the grip leaves beside a sideways acceleration [m/s^2].
template <class T>
inline T deceleration_left(const T& share, const T& grip, const T& sideways) {
  const T most = share * grip * gravity;
  return sqrt(max(0.0, most * most - sideways * sideways));
}

// Acceleration that the path asks of the controlled point, to the left of the car [m/s^2].
template <class T, class Car, class State, class ControllerMemory>
inline T sideways_demand(const Car& car, const T& curvature, const State& state,
                         const ControllerMemory& memory, const PathPoint<T>& point) {
  // The steering follows late: its cause leads, and the path is expected as much later.
  const auto& law = car.tuning.swerve;
  const T a = at<T>(memory.shift, memory.time).a;
  const Lateral<T> path = at<T>(memory.shift, memory.time - law.lag);
  const T along_lane = a + 2.0 * law.damping * law.frequency * (path.v - point.v_L.y) +
                       law.frequency * law.frequency * (path.d - point.d) +
                       curvature * point.v_L.x * point.v_L.x / max(0.1, 1.0 - curvature * point.d);
  const T ahead = state.a_B.x - state.yaw_rate * state.yaw_rate * percussion_arm(car);
  return (along_lane - ahead * point.turn.sine) / max(0.3, point.turn.cosine);
}

// How much of the front tyres' force may push to either side, in [-1, 1].
template <class T>
struct Sides {
  T left;
  T right;
};

// The rear must keep grip: once it slips near its peak, the front may not turn the car further in,
// and past the peak it must turn it back.
template <class T, class Car, class State>
inline Sides<T> turning_allowed(const Car& car, const State& state, const T& grip) {
  const auto& law = car.tuning.swerve;
  const T vy_rear = state.v_B.y - car.cg_to_rear_axle * state.yaw_rate;
  const T slip = vy_rear / max(state.v_B.x, vehicle::slip_speed_floor);
  const T excess = (abs(slip) / peak_slip(car, grip) - law.guard_from) / law.guard_width;
  const T allowed = clamp(1.0 - excess, -0.5, 1.0);
  // A rear that slides to the right carries force to the left: the car turns left.
  const auto right = slip < 0.0;
  return {select(right, allowed, 1.0), select(right, 1.0, allowed)};
}

// Load on the front axle under an acceleration ahead [N].
inline double front_load(const vehicle::Vehicle& car, double ax) {
  const Wheelwise<double> loads = vehicle::equations::wheel_loads<double>(car, ax, 0.0);
  return loads[front_left] + loads[front_right];
}

// Angle of the road wheels at which the front tyres push with the force that gives the demand.
template <class T, class Car, class State>
inline T steering_angle(const Car& car, const State& state, const T& grip, const T& demand) {
  const T load = front_load(car, state.a_B.x);
  const T peak = vehicle::equations::peak_friction<T>(car.tyre, 0.5 * load, grip);
  const T most = front_limit * peak * load;
  const T braking =
      min((state.brake_torque[front_left] + state.brake_torque[front_right]) / car.wheel_radius,
          0.98 * most);
  const T F_B = car.mass * car.cg_to_rear_axle / wheelbase(car) * demand;
  const T room = sqrt(most * most - braking * braking);
  const Sides<T> allowed = turning_allowed<T>(car, state, grip);
  const Turn<T> wheel = vehicle::equations::turn_by<T>(state.steering);
  const T F_T = clamp((F_B + braking * wheel.sine) / wheel.cosine, -room * allowed.right,
                      room * allowed.left);
  const T force = hypot(F_T, braking);
  const auto pushes = force > 0.0;
  const T vy = state.v_B.y + car.cg_to_front_axle * state.yaw_rate;
  const T course = atan2(vy, state.v_B.x);
  if (!any(pushes)) {
    return course;
  }
  const T slip = vehicle::equations::slip_for<T>(car.tyre, peak, min(1.0, force / (peak * load)));
  const T speed = hypot(state.v_B.x, vy);
  const T sliding = slip * F_T / force * max(speed, vehicle::slip_speed_floor);
  return select(pushes, course + asin(clamp(sliding / speed, -0.7, 0.7)), course);
}

template <class T, class Car, class State>
inline T holding_torque(const Car& car, const State& state, const T& speed, const T& grip) {
  constexpr double gain = 2.0;           // [1/s]
  constexpr double driven_share = 0.25;  // of the driven axles' grip: the rest is for the path
  const T left_over = deceleration_left<T>(1.0, grip, state.a_B.y) / (grip * gravity);
  const T most = driven_share * left_over * grip * driven_load(car);
  const T force = clamp(gain * car.mass * (speed - state.v_B.x), -most, most);
  return force * car.wheel_radius;
}

// What a plan wants of the speed, beside keeping it. Where `may_brake` is false, neither mask
// holds.
template <class T, class Mask, bool may_brake = true>
struct Wants {
  Mask rest;    // at once: emergency braking
  Mask slower;  // down to the speed to keep
  T strength;   // share of the grip that a stop asks for at most; 1 changes no bit
};

template <class T, class Mask, bool may_brake, class ControllerMemory>
inline Mask stops(const Wants<T, Mask, may_brake>& wants, const ControllerMemory& memory) {
  return wants.rest || (wants.slower && memory.speed < least_kept_speed);
}

// As `begin_abs`, where the mask holds.
template <class Mask, class T, class Abs>
inline void begin_abs_where(const Mask& mask, const T& speed, Abs& abs) {
  abs.speed = select(mask, speed, abs.speed);
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    abs.share[i] = select(mask, 1.0, abs.share[i]);
    abs.slip[i] = select(mask, 0.0, abs.slip[i]);
  }
}

// What steering leaves to the brakes.
template <class T>
struct BrakingConditions {
  T grip;      // friction coefficient [-]
  T sideways;  // acceleration across that the path takes [m/s^2]
  double dt;   // since the last command [s]
};

// Brakes or motor: what the plan wants of the speed, with what steering leaves.
template <class T, class Mask, bool may_brake, class Car, class State, class ControllerMemory,
          class Command>
inline void command_speed(const Car& car, const Wants<T, Mask, may_brake>& wants,
                          const BrakingConditions<T>& here, const State& state,
                          ControllerMemory& memory, Command& command) {
  const T& grip = here.grip;
  if constexpr (!may_brake) {
    command.motor_torque = holding_torque<T>(car, state, memory.speed, grip);
    return;
  }
  constexpr double approach = 0.25;  // [s]: the last of the braking fades within the brakes' delay
  const Mask stop = stops(wants, memory);
  // Where a bend needs all the grip, only less speed helps: a stop always brakes.
  const T share = select(wants.rest, T(1.0), combined_share);
  const T left_over = deceleration_left<T>(share, grip, here.sideways);
  const T slowing = min(left_over, (state.v_B.x - memory.speed) / approach);
  const T stopping =
      min(max(left_over, least_stop_share * grip * gravity), wants.strength * grip * gravity);
  const T wanted = select(stop, stopping,
                          select(wants.slower && state.v_B.x > memory.speed + 0.3, slowing, 0.0));
  const Mask brakes = stop || wanted > 0.0;
  if (any(brakes)) {
    const Wheelwise<T> torque =
        vehicle::equations::deployed_brakes<T>(car, state, wanted, grip, here.dt, memory.abs);
    for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
      command.brake_torque[i] = select(brakes, torque[i], 0.0);
    }
  }
  if (!all(brakes)) {
    begin_abs_where<Mask, T>(!brakes, state.v_B.x, memory.abs);
    command.motor_torque = select(brakes, 0.0, holding_torque<T>(car, state, memory.speed, grip));
  }
}

template <class T, class Mask, bool may_brake, class Car, class State, class ControllerMemory>
inline void watch_recovery(const Car& car, const Wants<T, Mask, may_brake>& wants,
                           const PathPoint<T>& point, const State& state, double dt,
                           ControllerMemory& memory) {
  constexpr double near_d = 0.2;      // [m]
  constexpr double near_speed = 1.0;  // [m/s]
  const double near_heading = from_degrees(2.0);
  const T d = point.d - percussion_arm(car) * point.turn.sine;
  const Mask slow_enough = !wants.slower || state.v_B.x < memory.speed + near_speed;
  const Mask recovered =
      abs(d - memory.end_d) < near_d && abs(point.heading) < near_heading && slow_enough;
  memory.recovered_for = select(recovered, memory.recovered_for + dt, 0.0);
}

// What there is beside the car's own motion when a path is followed.
template <class T>
struct PathConditions {
  T curvature;  // of the lane [1/m]
  T grip;       // friction coefficient [-]
  double dt;    // since the last command [s]
};

// What to tell a car that follows a path.
template <class T, class Command, class Mask, bool may_brake, class Car, class State,
          class ControllerMemory>
inline Command follow_path(const Car& car, const Wants<T, Mask, may_brake>& wants,
                           const PathConditions<T>& here, const State& state,
                           const PathPoint<T>& point, ControllerMemory& memory) {
  Command command;
  const T& grip = here.grip;
  const T demand = sideways_demand<T>(car, here.curvature, state, memory, point);
  const T most = grip * gravity;
  const T sideways = min(max(abs(demand), abs(state.a_B.y)), most);
  const T speed = hypot(state.v_B.x, state.v_B.y);
  const Mask moves = speed > 0.0;
  if (any(moves)) {
    const T angle = steering_angle<T>(car, state, grip, clamp(demand, -most, most));
    command.steering = select(moves, angle * min(1.0, speed / crawl), 0.0);
  }
  command_speed<T>(car, wants,
                   BrakingConditions<T>{grip, T(select(speed > crawl, sideways, 0.0)), here.dt},
                   state, memory, command);
  watch_recovery<T>(car, wants, point, state, here.dt, memory);
  return command;
}

// What is known of a car's motion, as `DriftMotion`.
template <class T>
struct Drifting {
  T heading;
  T vx;
  T vy;
  T yaw_rate;
  T ax;
  T ay;
};

// How much more turning is wanted, as a share of what the actuators can do, in [-1, 1].
template <class T, class Law, class ControllerMemory>
inline T drift_demand(const Law& law, const T& grip, const Drifting<T>& motion, const T& speed,
                      const ControllerMemory& memory) {
  constexpr double least_speed = 1.0;  // [m/s]
  const T foreseen = motion.heading + law.lead * motion.yaw_rate;
  const T slowing = law.slide_share * grip * gravity;
  const T wanted =
      law.turning * (0.5 * std::numbers::pi - foreseen) * slowing / max(speed, least_speed);
  const T missing = clamp(wanted, -law.most_turning, law.most_turning) - motion.yaw_rate -
                    law.lead * memory.yaw_acceleration;
  return clamp(law.gain * missing, -1.0, 1.0);
}

// The motor may turn a slow car, but not drive it off: it would never rest.
template <class T, class Car, class Law>
inline T drift_motor(const Car& car, const Law& law, const T& grip, const T& speed, const T& vx,
                     const T& in) {
  constexpr double slow = 2.0;  // [m/s]
  const T weight = car.mass * gravity;
  const T torque = law.motor_share * in * min(car.motor_limit, grip * weight * car.wheel_radius);
  return select(speed < slow && torque * vx > 0.0, 0.0, torque);
}

// How fast the turning rate grows [rad/s^2]; notes the rate.
inline double turning_growth(DriftState& memory, double yaw_rate, double dt) {
  const double growth = (yaw_rate - memory.yaw_rate) / dt;
  memory.yaw_rate = yaw_rate;
  return growth;
}
inline double smoothing_share(const DriftState& /*memory*/, double dt, double time) {
  return std::min(1.0, dt / time);
}

// The drift to the left.
template <class T, class Command, class Car, class Law, class ControllerMemory>
inline Command drift(const Car& car, const Law& law, const T& grip, const Drifting<T>& motion,
                     double dt, ControllerMemory& memory) {
  Command command;
  constexpr double smoothing = 0.02;    // [s]
  constexpr double over_brake = 1.6;    // of what a wheel can take: it locks
  constexpr double least_load = 500.0;  // [N] that a lifted wheel is braked for
  const T growth = turning_growth(memory, motion.yaw_rate, dt);
  memory.yaw_acceleration = memory.yaw_acceleration + smoothing_share(memory, dt, smoothing) *
                                                          (growth - memory.yaw_acceleration);

  const T speed = hypot(motion.vx, motion.vy);
  const T u = drift_demand<T>(law, grip, motion, speed, memory);
  const T in = max(u, 0.0);
  const T out = max(-u, 0.0);
  const T course = atan2(motion.vy + car.cg_to_front_axle * motion.yaw_rate, max(motion.vx, 0.1));
  const auto locks = speed < law.lock_speed;
  command.steering =
      select(locks, 0.0, clamp(course + law.steering * u, -car.steering_limit, car.steering_limit));
  const T front = 1.0 - law.front_release * in;
  const T rear = 1.0 - law.rear_release * out;
  const T left = 1.0 - law.outer_release * out;
  const T right = 1.0 - law.outer_release * in;
  const Wheelwise<T> share{front * left, front * right, rear * left, rear * right};
  const Wheelwise<T> loads = vehicle::equations::wheel_loads<T>(car, motion.ax, motion.ay);
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    command.brake_torque[i] =
        select(locks, car.brake_limit,
               over_brake * share[i] * grip * max(loads[i], least_load) * car.wheel_radius);
  }
  command.motor_torque = select(locks, 0.0, drift_motor<T>(car, law, grip, speed, motion.vx, in));
  return command;
}

}  // namespace saca::manoeuvre::equations

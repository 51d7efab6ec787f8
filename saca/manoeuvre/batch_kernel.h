#pragma once

#include "saca/manoeuvre/batch_lane.h"

/// A step of the batch, for a number type `T`. The equations are those of the scalar model; the
/// scheme is another: see `batch.h`. Not part of the library's interface.
namespace saca::manoeuvre::lanes {

using namespace number;
using vehicle::num_wheels;
using vehicle::equations::Pair;
using vehicle::equations::Turn;
using vehicle::equations::Wheelwise;

/// As `VehicleState`, as far as a controller sees it.
template <class T>
struct Seen {
  Pair<T> v_B, a_B;
  T yaw_rate, steering, motor_torque;
  Wheelwise<T> brake_torque, wheel_speed;
};

template <class T>
struct Told {
  T steering = 0.0;
  Wheelwise<T> brake_torque{T(0.0), T(0.0), T(0.0), T(0.0)};
  T motor_torque = 0.0;
};

template <class T>
inline Seen<T> seen(const vehicle::equations::Flow<T>& flow, const Pair<T>& a_B) {
  using F = vehicle::equations::Flow<T>;
  return {
      .v_B = {flow[F::vx], flow[F::vy]},
      .a_B = a_B,
      .yaw_rate = flow[F::yaw_rate],
      .steering = flow[F::steering],
      .motor_torque = flow[F::motor],
      .brake_torque = {flow[F::brake], flow[F::brake + 1], flow[F::brake + 2], flow[F::brake + 3]},
      .wheel_speed = {flow[F::wheel], flow[F::wheel + 1], flow[F::wheel + 2], flow[F::wheel + 3]}};
}

/// Offset and heading against a lane that starts at the origin along x: as `world::to_lane`.
template <class T>
struct InLane {
  T d, heading;
};
template <class T>
inline InLane<T> in_lane(const T& curvature, const T& x, const T& y, const T& yaw) {
  const T across = 1.0 - curvature * y;
  const T along = curvature * x;
  T turned = 0.0;
  if (any(curvature > 0.0 || curvature < 0.0)) {
    turned = atan2(along, across);
  }
  const T r = sqrt(along * along + across * across);
  const T heading = yaw - turned;
  constexpr double round_once = 2.0 * std::numbers::pi;
  return {(2.0 * y - curvature * (x * x + y * y)) / (1.0 + r),
          heading - round_once * round(heading / round_once)};
}

template <class T>
inline Told<T> drift_told(const FixedLane<T>& fixed, const Seen<T>& state, const InLane<T>& place,
                          MemoryLane<T>& memory) {
  const T& side = fixed.side;
  Told<T> told;
  equations::drift<T>(
      fixed.known, fixed.known.tuning.drift, fixed.known_grip,
      equations::Drifting<T>{side * place.heading, state.v_B.x, side * state.v_B.y,
                             side * state.yaw_rate, state.a_B.x, side * state.a_B.y},
      step, memory.drift, told);
  const auto left = side > 0.0;
  const Wheelwise<T> torque = told.brake_torque;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    told.brake_torque[i] = select(left, torque[i], torque[i ^ 1U]);
  }
  told.steering = side * told.steering;
  return told;
}

template <class T>
inline Told<T> path_told(const FixedLane<T>& fixed, const Seen<T>& state, const T& x, const T& y,
                         const T& yaw, const Turn<T>& heading, MemoryLane<T>& memory) {
  const T& arm = fixed.known.percussion_arm;
  const InLane<T> place =
      in_lane<T>(fixed.curvature, x + arm * heading.cosine, y + arm * heading.sine, yaw);
  const auto point =
      equations::path_point<T>(place.d, place.heading, arm, state.v_B, state.yaw_rate);
  const auto slower = fixed.slower > 0.5;
  const equations::Wants<std::remove_const_t<decltype(slower)>> wants{fixed.rest > 0.5, slower};
  Told<T> told;
  equations::follow_path<T>(fixed.known, wants, fixed.curvature, fixed.known_grip, state, point,
                            step, memory, told);
  return told;
}

/// `control`, for mixed plans.
template <class T>
inline Told<T> told(const FixedLane<T>& fixed, const Seen<T>& state,
                    const vehicle::equations::Flow<T>& flow, const Turn<T>& heading,
                    MemoryLane<T>& memory) {
  using F = vehicle::equations::Flow<T>;
  const auto drifts = fixed.drifts > 0.5;
  Told<T> result;
  if (!all(drifts)) {
    result = path_told<T>(fixed, state, flow[F::x], flow[F::y], flow[F::yaw], heading, memory);
  }
  if (any(drifts)) {
    const InLane<T> place = in_lane<T>(fixed.curvature, flow[F::x], flow[F::y], flow[F::yaw]);
    const Told<T> drift = drift_told<T>(fixed, state, place, memory);
    result.steering = select(drifts, drift.steering, result.steering);
    result.motor_torque = select(drifts, drift.motor_torque, result.motor_torque);
    for (std::size_t i = 0; i < num_wheels; ++i) {
      result.brake_torque[i] = select(drifts, drift.brake_torque[i], result.brake_torque[i]);
    }
  }
  memory.time = memory.time + step;
  return result;
}

/// Actuators under a held command: Heun's scheme.
template <class T>
inline void move_actuators(const CarLane<T>& car, const Told<T>& told,
                           const vehicle::equations::Flow<T>& now,
                           vehicle::equations::Flow<T>& next) {
  using F = vehicle::equations::Flow<T>;
  constexpr std::array<std::size_t, 6> moved{F::steering,  F::brake,     F::brake + 1,
                                             F::brake + 2, F::brake + 3, F::motor};
  F rate;
  F then;
  F tried;
  vehicle::equations::actuator_rates<T>(car, now, told, rate);
  for (const std::size_t i : moved) {
    tried[i] = now[i] + step * rate[i];
  }
  vehicle::equations::actuator_rates<T>(car, tried, told, then);
  for (const std::size_t i : moved) {
    next[i] = now[i] + 0.5 * step * (rate[i] + then[i]);
  }
}

/// How the force along a wheel grows with its sliding velocity [N s/m]: what falls after the peak.
template <class T>
inline T drag_slope(const CarLane<T>& car, const vehicle::equations::Wheels<T>& wheels,
                    const vehicle::equations::Flow<T>& flow, std::size_t i, const T& grip) {
  const T x = vehicle::equations::is_front(i) ? T(car.front_arm) : T(-car.rear_arm);
  const T y = vehicle::equations::is_left(i) ? T(car.half_track) : T(-car.half_track);
  using F = vehicle::equations::Flow<T>;
  const T vx = flow[F::vx] - flow[F::yaw_rate] * y;
  const T vy = flow[F::vy] + flow[F::yaw_rate] * x;
  const T slip_x = wheels.v_x[i] - car.wheel_radius * flow[F::wheel + i];
  const T slipping = slip_x * slip_x + wheels.v_y[i] * wheels.v_y[i];
  const T rise = vehicle::equations::steepness<T>(
      car.tyre, vehicle::equations::peak_friction<T>(car.tyre, wheels.load[i], grip));
  const T zz = rise * rise *
               (slipping * (1.0 / max(vx * vx + vy * vy,
                                      vehicle::slip_speed_floor * vehicle::slip_speed_floor)));
  const T ratio = vehicle::equations::magic_ratio<T>(car.tyre.shape, zz);
  // d sin(C atan z) / dz = C cos(C atan z) / (1 + z^2)
  const T size = sqrt(max(0.0, 1.0 - zz * ratio * ratio));
  const T cosine = select(zz > car.tyre.peak_zz, -size, size);
  const T over_drag = car.tyre.shape * cosine / ((1.0 + zz) * ratio);
  const T share = slip_x * slip_x / max(slipping, 1e-9);
  return wheels.drag[i] * (1.0 + share * (over_drag - 1.0));
}

/// Spin of the wheels, taken implicitly: road and motor by a rational approximation of the
/// exponential, for a wheel that moves evenly faster or slower, of second order and damped where it
/// is stiff; brakes as dry friction.
template <class T>
inline void spin_wheels(const CarLane<T>& car, const vehicle::equations::Wheels<T>& wheels,
                        const vehicle::equations::Flow<T>& now, vehicle::equations::Flow<T>& next,
                        const Wheelwise<T>& slopes) {
  using F = vehicle::equations::Flow<T>;
  const T motor = 0.5 * (now[F::motor] + next[F::motor]);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T x = vehicle::equations::is_front(i) ? T(car.front_arm) : T(-car.rear_arm);
    const T y = vehicle::equations::is_left(i) ? T(car.half_track) : T(-car.half_track);
    const T vx = next[F::vx] - next[F::yaw_rate] * y;
    const T vy = next[F::vy] + next[F::yaw_rate] * x;
    const T v_x =
        vehicle::equations::is_front(i) ? wheels.cosine[i] * vx + wheels.sine[i] * vy : vx;
    const auto& inertia = wheel_inertia(car, i);
    const T& slope = slopes[i];
    const T z = max(-0.5, step * car.wheel_radius * car.wheel_radius * slope / inertia);
    const T gained = (1.0 + z) / (2.0 + z) * (v_x - wheels.v_x[i]);
    const T F_x = wheels.F_x[i] - slope * gained;
    const T turning = vehicle::equations::turning_torque<T>(car, i, motor, F_x);
    const T grown = 1.0 + 0.5 * z;
    const T share = step * grown / (1.0 + z * grown) / inertia;
    const T brake = 0.5 * (now[F::brake + i] + next[F::brake + i]);
    const T free = now[F::wheel + i] + share * turning;
    const T stopped = share * brake;
    next[F::wheel + i] = free - clamp(free, -stopped, stopped);
  }
}

/// What was told `delay` steps ago.
template <class T>
inline Wheelwise<T> delayed(const FixedLane<T>& fixed, const MovingLane<T>& moving, std::size_t now,
                            std::size_t delay) {
  const auto& newer = moving.brake_line[(now - delay) % num_slots];
  const auto& older = moving.brake_line[(now - delay - 1) % num_slots];
  Wheelwise<T> torque;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    torque[i] = min(newer[i] + fixed.delay_share * (older[i] - newer[i]), fixed.real.brake_limit);
  }
  return torque;
}

/// The scalar model holds a command for 1 ms, so on the average it acts 0.5 ms late. Held for a
/// whole step it would be later: it is taken for 0.5 ms before the step's middle instead, this
/// share of the way to the next one.
constexpr double ahead = 0.5 * (1.0 - vehicle::usual_step / step);

/// Writes what was told into the brake line, where the last slot can still be changed.
template <class T, class Mask>
inline void hold(MovingLane<T>& moving, std::size_t now, const Wheelwise<T>& torque,
                 const Mask& first) {
  auto& newest = moving.brake_line[now % num_slots];
  auto& last = moving.brake_line[(now - 1) % num_slots];
  for (std::size_t i = 0; i < num_wheels; ++i) {
    newest[i] = torque[i];
    last[i] = select(first, last[i], last[i] + ahead * (torque[i] - last[i]));
  }
}

/// The body: Adams and Bashforth's scheme of second order; Euler's at the start.
template <class T, class Mask>
inline void move_body(const vehicle::equations::Flow<T>& flow,
                      const vehicle::equations::Flow<T>& rate, const Mask& first,
                      MovingLane<T>& moving, vehicle::equations::Flow<T>& next) {
  using F = vehicle::equations::Flow<T>;
  constexpr std::array<std::size_t, 8> body{F::x,  F::y,        F::yaw, F::vx,
                                            F::vy, F::yaw_rate, F::ax,  F::ay};
  const T old = select(first, T(0.0), 0.5 * step);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const std::size_t at = body[i];
    const T change = step * rate[at] + old * (rate[at] - moving.rate[i]);
    moving.rate[i] = rate[at];
    if (at == F::x || at == F::y) {
      T& lost = at == F::x ? moving.lost_x : moving.lost_y;
      const T whole = change - lost;
      next[at] = flow[at] + whole;
      lost = (next[at] - flow[at]) - whole;
    } else {
      next[at] = flow[at] + change;
    }
  }
}

/// @param now    counts steps: where the brake line is written
/// @param late   brakes' dead time in steps
template <class T>
inline void advance(const FixedLane<T>& fixed, MovingLane<T>& moving, std::size_t now,
                    std::size_t late) {
  using F = vehicle::equations::Flow<T>;
  F flow = moving.flow;  // its own: what is written to the lane cannot change it
  const auto held = vehicle::equations::is_held<T>(fixed.real, flow);
  if (any(held)) {
    for (std::size_t i = F::vx; i < F::wheel + num_wheels; ++i) {  // velocities, then wheels
      flow[i] = select(held, 0.0, flow[i]);
    }
  }
  const Turn<T> heading = vehicle::equations::turn_by<T>(flow[F::yaw]);
  const Turn<T> middle = vehicle::equations::turn_by<T>(flow[F::steering]);
  const vehicle::equations::Wheels<T> wheels = vehicle::equations::wheels_of<T>(
      fixed.real, flow, middle, {fixed.grip, fixed.grip, fixed.grip, fixed.grip});
  Wheelwise<T> slopes;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    slopes[i] = drag_slope<T>(fixed.real, wheels, flow, i, fixed.grip);
  }
  F rate;
  Pair<T> force = vehicle::equations::body_rates<T>(fixed.real, flow, wheels, heading, rate);
  if (any(held)) {
    force = {select(held, 0.0, force.x), select(held, 0.0, force.y)};
    for (const std::size_t i : {F::x, F::y, F::yaw, F::vx, F::vy, F::yaw_rate}) {
      rate[i] = select(held, 0.0, rate[i]);
      moving.rate[i] = select(held, 0.0, moving.rate[i]);
    }
  }
  vehicle::equations::load_rates<T>(fixed.real, flow, force, rate);

  // Sensors tell the acceleration of 1 ms ago.
  const auto first = moving.first > 0.5;
  const Pair<T> a{force.x / fixed.real.mass, force.y / fixed.real.mass};
  constexpr double ago = 0.5 + 0.5 * vehicle::usual_step / step;
  const Pair<T> told_a{select(first, moving.ax, a.x + ago * (moving.ax - a.x)),
                       select(first, moving.ay, a.y + ago * (moving.ay - a.y))};
  moving.ax = a.x;
  moving.ay = a.y;
  Told<T> command = told<T>(fixed, seen<T>(flow, told_a), flow, heading, moving.memory);
  command.steering = clamp(command.steering, -fixed.real.steering_limit, fixed.real.steering_limit);
  command.motor_torque =
      clamp(command.motor_torque, -fixed.real.motor_limit, fixed.real.motor_limit);
  // Likewise for the steering, which follows at once: what will be told in the step's middle.
  const T turned = command.steering - moving.told_steering;
  moving.told_steering = command.steering;
  command.steering = command.steering + select(first, T(0.0), ahead * turned);
  hold(moving, now, command.brake_torque, first);
  command.brake_torque = delayed<T>(fixed, moving, now, late);

  F next;
  move_actuators<T>(fixed.real, command, flow, next);
  move_body(flow, rate, first, moving, next);
  spin_wheels<T>(fixed.real, wheels, flow, next, slopes);
  if (any(held)) {
    for (std::size_t i = F::wheel; i < F::wheel + num_wheels; ++i) {
      next[i] = select(held, 0.0, next[i]);
    }
  }
  moving.first = T(0.0);
  moving.flow = next;
}

}  // namespace saca::manoeuvre::lanes

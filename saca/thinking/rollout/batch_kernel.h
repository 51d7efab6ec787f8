#pragma once

#include "saca/thinking/rollout/batch_contacts.h"

/// A step of the batch, for a number type `T`. The equations are those of the scalar model; the
/// scheme is another: see `batch.h`. Not part of the library's interface.
namespace saca::rollout::lanes {

/// As `VehicleState`, as far as a controller sees it.
template <class T>
struct ControllerInput {
  Pair<T> v_B, a_B;
  T yaw_rate, steering, motor_torque;
  Wheelwise<T> brake_torque, wheel_speed;
};

template <class T>
struct ActuatorCommand {
  T steering = 0.0;
  Wheelwise<T> brake_torque{T(0.0), T(0.0), T(0.0), T(0.0)};
  T motor_torque = 0.0;
};

template <class T>
inline ControllerInput<T> seen(const vehicle::equations::StateVector<T>& state_vector,
                               const Pair<T>& a_B) {
  using F = vehicle::equations::StateVector<T>;
  return {.v_B = {state_vector[F::vx], state_vector[F::vy]},
          .a_B = a_B,
          .yaw_rate = state_vector[F::yaw_rate],
          .steering = state_vector[F::steering],
          .motor_torque = state_vector[F::motor],
          .brake_torque = {state_vector[F::brake], state_vector[F::brake + 1],
                           state_vector[F::brake + 2], state_vector[F::brake + 3]},
          .wheel_speed = {state_vector[F::wheel], state_vector[F::wheel + 1],
                          state_vector[F::wheel + 2], state_vector[F::wheel + 3]}};
}

/// Offset and heading against a lane that starts at the origin along x: as `world::to_lane`.
template <class T>
struct InLane {
  T d, heading;
};
template <class T>
inline auto bends_of(const T& curvature) {
  return curvature > 0.0 || curvature < 0.0;
}
template <class T>
inline InLane<T> in_lane(const T& curvature, const T& x, const T& y, const T& yaw) {
  constexpr double round_once = 2.0 * std::numbers::pi;
  const auto wrapped = [](const T& angle) {
    return T(angle - round_once * round(angle / round_once));
  };
  if (!any(bends_of(curvature))) {
    return {y, wrapped(yaw)};
  }
  const T across = 1.0 - curvature * y;
  const T along = curvature * x;
  const T r = sqrt(along * along + across * across);
  return {(2.0 * y - curvature * (x * x + y * y)) / (1.0 + r), wrapped(yaw - atan2(along, across))};
}

template <Kind kind, class T>
inline ActuatorCommand<T> drift_command(const FixedLane<T>& fixed, const ControllerInput<T>& state,
                                        const InLane<T>& place, MemoryLane<T>& memory) {
  const T& side = fixed.side;
  auto command = manoeuvre::equations::drift<T, ActuatorCommand<T>>(
      fixed.known, fixed.known.tuning.drift, fixed.known_grip,
      manoeuvre::equations::Drifting<T>{side * place.heading, state.v_B.x, side * state.v_B.y,
                                        side * state.yaw_rate, state.a_B.x, side * state.a_B.y},
      step_of(kind), memory.drift);
  const auto left = side > 0.0;
  const Wheelwise<T> torque = command.brake_torque;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    command.brake_torque[i] = select(left, torque[i], torque[i ^ 1U]);
  }
  command.steering = side * command.steering;
  return command;
}

template <Kind kind, class T>
inline ActuatorCommand<T> path_command(const FixedLane<T>& fixed, const ControllerInput<T>& state,
                                       const vehicle::equations::StateVector<T>& state_vector,
                                       const Turn<T>& heading, MemoryLane<T>& memory) {
  using F = vehicle::equations::StateVector<T>;
  const T& x = state_vector[F::x];
  const T& y = state_vector[F::y];
  const T& yaw = state_vector[F::yaw];
  const T& arm = fixed.known.percussion_arm;
  const InLane<T> place =
      in_lane<T>(fixed.curvature, x + arm * heading.cosine, y + arm * heading.sine, yaw);
  const T vy = state.v_B.y + state.yaw_rate * arm;
  Turn<T> turn = heading;
  const auto bends = bends_of(fixed.curvature);
  if (any(bends)) {
    const Turn<T> in_bend = vehicle::equations::turn_by<T>(place.heading);
    turn = {select(bends, in_bend.cosine, heading.cosine),
            select(bends, in_bend.sine, heading.sine)};
  }
  const manoeuvre::equations::PathPoint<T> point{
      place.d,
      place.heading,
      turn,
      {turn.cosine * state.v_B.x - turn.sine * vy, turn.sine * state.v_B.x + turn.cosine * vy}};
  const auto slower = fixed.slower > 0.5;
  const manoeuvre::equations::Wants<T, std::remove_const_t<decltype(slower)>, kind == Kind::brakes>
      wants{fixed.rest > 0.5, slower, fixed.strength};
  return manoeuvre::equations::follow_path<T, ActuatorCommand<T>>(
      fixed.known, wants,
      manoeuvre::equations::PathConditions<T>{fixed.curvature, fixed.known_grip, step_of(kind)},
      state, point, memory);
}

/// `control`, for plans of one kind.
template <Kind kind, class T>
inline ActuatorCommand<T> control(const FixedLane<T>& fixed, const ControllerInput<T>& state,
                                  const vehicle::equations::StateVector<T>& state_vector,
                                  const Turn<T>& heading, MemoryLane<T>& memory) {
  using F = vehicle::equations::StateVector<T>;
  ActuatorCommand<T> result;
  if constexpr (kind == Kind::drifts) {
    const InLane<T> place =
        in_lane<T>(fixed.curvature, state_vector[F::x], state_vector[F::y], state_vector[F::yaw]);
    result = drift_command<kind, T>(fixed, state, place, memory);
  } else {
    result = path_command<kind, T>(fixed, state, state_vector, heading, memory);
  }
  memory.time = memory.time + step_of(kind);
  return result;
}

/// Actuators under a held command: Heun's scheme.
template <Kind kind, class T>
inline void move_actuators(const CarLane<T>& car, const ActuatorCommand<T>& command,
                           const vehicle::equations::StateVector<T>& now,
                           vehicle::equations::StateVector<T>& next) {
  using F = vehicle::equations::StateVector<T>;
  constexpr double step = step_of(kind);
  // How far what follows without limit comes in a step.
  const auto share = [](const Divisor<T>& lag) {
    const T whole = T(step) / lag;
    return T(whole - 0.5 * whole * whole);
  };
  const T braked = share(car.brake_lag);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T& torque = now[F::brake + i];
    next[F::brake + i] = torque + braked * (command.brake_torque[i] - torque);
  }
  next[F::motor] = now[F::motor] + share(car.motor_lag) * (command.motor_torque - now[F::motor]);
  const auto rate = [&](const T& angle) {
    return clamp((command.steering - angle) / car.steering_lag, -car.steering_rate,
                 car.steering_rate);
  };
  const T first = rate(now[F::steering]);
  const T second = rate(now[F::steering] + step * first);
  next[F::steering] = now[F::steering] + 0.5 * step * (first + second);
}

/// Spin of the wheels, taken implicitly: road and motor by a rational approximation of the
/// exponential, for a wheel that moves evenly faster or slower, of second order and damped where it
/// is stiff; brakes as dry friction.
template <Kind kind, class T>
inline void spin_wheels(const CarLane<T>& car, const WheelContacts<T>& contacts,
                        const vehicle::equations::StateVector<T>& now,
                        vehicle::equations::StateVector<T>& next) {
  using F = vehicle::equations::StateVector<T>;
  const CentreVelocities<T> v_B = centre_velocities(car, next);
  const std::array<T, 2> per_inertia{T(step_of(kind)) / car.front_wheel_inertia,
                                     T(step_of(kind)) / car.rear_wheel_inertia};
  const T squared = car.wheel_radius * car.wheel_radius;
  const std::array<T, 2> stiff{squared * per_inertia[0], squared * per_inertia[1]};
  const T motor_gain = next[F::motor] - now[F::motor];
  for (std::size_t i = 0; i < num_wheels; ++i) {
    T v_x = v_B.x[i % 2];
    if (vehicle::equations::is_front(i)) {
      v_x = contacts.front[i].cosine * v_x + contacts.front[i].sine * v_B.y[0];
    }
    const T& slope = contacts.slope[i];
    const T z = max(-0.5, stiff[i / 2] * slope);
    const T grown = 1.0 + 0.5 * z;
    const T slowed = 1.0 + z * grown;
    const T inverse = 1.0 / (grown * slowed);
    // How much of what changes within the step counts: half, or more where the wheel follows fast.
    const T weight = (0.5 + 0.5 * z) * slowed * inverse;
    const T F_x = contacts.F_x[i] - slope * (weight * (v_x - contacts.v_x[i]));
    const T motor = now[F::motor] + weight * motor_gain;
    const T brake = now[F::brake + i] + weight * (next[F::brake + i] - now[F::brake + i]);
    const T turning = vehicle::equations::turning_torque<T>(car, i, motor, F_x);
    const T share = per_inertia[i / 2] * (grown * grown) * inverse;
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

/// Writes what was told into the brake line, where the last slot can still be changed.
///
/// The scalar model holds a command for 1 ms, so on the average it acts 0.5 ms late. Held for a
/// whole step it would be later: it is taken for 0.5 ms before the step's middle instead.
template <Kind kind, class T, class Mask>
inline void hold(MovingLane<T>& moving, std::size_t now, const Wheelwise<T>& torque,
                 const Mask& first) {
  auto& newest = moving.brake_line[now % num_slots];
  auto& last = moving.brake_line[(now - 1) % num_slots];
  const T share = select(first, T(0.0), newer(step_of(kind)));
  for (std::size_t i = 0; i < num_wheels; ++i) {
    newest[i] = torque[i];
    last[i] = last[i] + share * (torque[i] - last[i]);
  }
}

/// The body: Adams and Bashforth's scheme of second order; Euler's at the start.
template <Kind kind, class T, class Mask>
inline void move_body(const vehicle::equations::StateVector<T>& state_vector,
                      const vehicle::equations::StateVector<T>& rate, const Mask& first,
                      MovingLane<T>& moving, vehicle::equations::StateVector<T>& next) {
  using F = vehicle::equations::StateVector<T>;
  constexpr std::array<std::size_t, 8> body{F::x,  F::y,        F::yaw, F::vx,
                                            F::vy, F::yaw_rate, F::ax,  F::ay};
  constexpr double step = step_of(kind);
  const T old = select(first, T(0.0), 0.5 * step);
  const T now = step + old;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const std::size_t at = body[i];
    if (at == F::x || at == F::y) {
      T& lost = at == F::x ? moving.lost_x : moving.lost_y;
      const T whole = now * rate[at] - (old * moving.rate[i] + lost);
      next[at] = state_vector[at] + whole;
      lost = (next[at] - state_vector[at]) - whole;
    } else {
      next[at] = now * rate[at] + (state_vector[at] - old * moving.rate[i]);
    }
    moving.rate[i] = rate[at];
  }
}

/// What the sensors tell: the acceleration of 1 ms ago. The present one is kept for the next step.
/// @param force  that acts now
template <Kind kind, class T, class Mask>
inline Pair<T> sensed_acceleration(const FixedLane<T>& fixed, const Pair<T>& force,
                                   const Mask& first, MovingLane<T>& moving) {
  const Pair<T> a{force.x / fixed.real.mass, force.y / fixed.real.mass};
  constexpr double ago = 1.0 - newer(step_of(kind));
  const Pair<T> sensed{select(first, moving.ax, a.x + ago * (moving.ax - a.x)),
                       select(first, moving.ay, a.y + ago * (moving.ay - a.y))};
  moving.ax = a.x;
  moving.ay = a.y;
  return sensed;
}

/// What the actuators are told, before the brake line: the steering as it will be in the middle of
/// the step.
template <Kind kind, class T, class Mask>
inline ActuatorCommand<T> command_of(const FixedLane<T>& fixed, const Pair<T>& sensed_a,
                                     const Turn<T>& heading, const Mask& first,
                                     MovingLane<T>& moving) {
  ActuatorCommand<T> command = control<kind, T>(fixed, seen<T>(moving.state_vector, sensed_a),
                                                moving.state_vector, heading, moving.memory);
  command.steering = clamp(command.steering, -fixed.real.steering_limit, fixed.real.steering_limit);
  command.motor_torque =
      clamp(command.motor_torque, -fixed.real.motor_limit, fixed.real.motor_limit);
  // The steering follows at once, without a line: what will be told in the step's middle (hold).
  const T turned = command.steering - moving.command_steering;
  moving.command_steering = command.steering;
  command.steering = command.steering + select(first, T(0.0), newer(step_of(kind)) * turned);
  return command;
}

/// @param now    counts steps: where the brake line is written
/// @param late   brakes' dead time in steps
template <Kind kind, class T>
inline void advance(const FixedLane<T>& fixed, MovingLane<T>& moving, std::size_t now,
                    std::size_t late) {
  using F = vehicle::equations::StateVector<T>;
  F& state_vector = moving.state_vector;
  const auto held = vehicle::equations::is_held<T>(fixed.real, state_vector);
  if (any(held)) {
    for (std::size_t i = F::vx; i < F::wheel + num_wheels; ++i) {  // velocities, then wheels
      state_vector[i] = select(held, 0.0, state_vector[i]);
    }
  }
  const Turn<T> heading = vehicle::equations::turn_by<T>(state_vector[F::yaw]);
  const Turn<T> middle = vehicle::equations::turn_by<T>(state_vector[F::steering]);
  const WheelContacts<T> contacts = contacts_of<T>(fixed.real, state_vector, middle, fixed.grip);
  F rate;
  Pair<T> force = body_rates<T>(fixed.real, state_vector, contacts, heading, rate);
  if (any(held)) {
    force = {select(held, 0.0, force.x), select(held, 0.0, force.y)};
    for (const std::size_t i : {F::x, F::y, F::yaw, F::vx, F::vy, F::yaw_rate}) {
      rate[i] = select(held, 0.0, rate[i]);
      moving.rate[i] = select(held, 0.0, moving.rate[i]);
    }
  }
  vehicle::equations::load_rates<T>(fixed.real, state_vector, force, rate);

  const auto first = moving.first > 0.5;
  const Pair<T> sensed_a = sensed_acceleration<kind>(fixed, force, first, moving);
  ActuatorCommand<T> command = command_of<kind>(fixed, sensed_a, heading, first, moving);
  hold<kind>(moving, now, command.brake_torque, first);
  command.brake_torque = delayed<T>(fixed, moving, now, late);

  F next;
  move_actuators<kind, T>(fixed.real, command, state_vector, next);
  move_body<kind>(state_vector, rate, first, moving, next);
  spin_wheels<kind, T>(fixed.real, contacts, state_vector, next);
  if (any(held)) {
    for (std::size_t i = F::wheel; i < F::wheel + num_wheels; ++i) {
      next[i] = select(held, 0.0, next[i]);
    }
  }
  moving.first = T(0.0);
  moving.state_vector = next;
}

}  // namespace saca::rollout::lanes

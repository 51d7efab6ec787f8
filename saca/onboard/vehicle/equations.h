#pragma once

#include <array>
#include <cstddef>

#include "saca/base/core/number.h"
#include "saca/onboard/vehicle/tyre.h"
#include "saca/onboard/vehicle/vehicle.h"

/// The vehicle's equations of motion, for any number type `T` (`core/number.h`): `vehicle.h` has
/// them for one car in `double`. `Car` is a `Vehicle`, or many side by side with fields of the same
/// names and the functions of `Vehicle` below, which are what does not change while a car moves.
/// What they mean, and their units, stand in `vehicle.h`.
namespace saca::vehicle::equations {

constexpr bool is_front(std::size_t wheel) {
  return wheel == front_left || wheel == front_right;
}
constexpr bool is_left(std::size_t wheel) {
  return wheel == front_left || wheel == rear_left;
}

inline double wheelbase(const Vehicle& car) noexcept {
  return car.cg_to_front_axle + car.cg_to_rear_axle;
}
inline double half_track(const Vehicle& car) noexcept {
  return 0.5 * car.track_width;
}
inline double wheel_inertia(const Vehicle& car, std::size_t wheel) noexcept {
  return is_front(wheel) ? car.front_wheel_inertia : car.rear_wheel_inertia;
}
/// Whether less of the motor, or half of it, is at the front axle.
inline bool front_rolls(const Vehicle& car) noexcept {
  return car.motor_front_share <= 0.5;
}
/// Drag over speed squared [N s^2/m^2].
inline double air_drag(const Vehicle& car) noexcept {
  return 0.5 * air_density * car.drag_area;
}
/// Load on an axle at rest [N].
inline double front_weight(const Vehicle& car) noexcept {
  return car.mass * gravity * car.cg_to_rear_axle / wheelbase(car);
}
inline double rear_weight(const Vehicle& car) noexcept {
  return car.mass * gravity * car.cg_to_front_axle / wheelbase(car);
}

/// A brake turns from full torque to none over the speed that it would take away in 1 / this [1/s].
constexpr double brake_stiffness = 1000.0;

/// Two numbers that belong together, in B.
template <class T>
struct Pair {
  T x = 0.0;
  T y = 0.0;
};

template <class T>
using Wheelwise = std::array<T, num_wheels>;

/// Everything of a state that has a rate.
template <class T>
struct StateVector {
  enum : std::size_t {
    x,
    y,
    yaw,
    vx,
    vy,
    yaw_rate,
    wheel,
    steering = wheel + 4,
    brake,
    motor = brake + 4,
    ax,
    ay,
    size
  };
  std::array<T, size> value{};

  T& operator[](std::size_t i) { return value[i]; }
  const T& operator[](std::size_t i) const { return value[i]; }
};

/// A turn, as its cosine and sine.
template <class T>
struct Turn {
  T cosine = 1.0;
  T sine = 0.0;
};

template <class T>
inline Turn<T> turn_by(const T& angle) {
  return {cos(angle), sin(angle)};
}

/// Load on each wheel under a lasting acceleration of the body [N].
template <class T, class Car>
inline Wheelwise<T> wheel_loads(const Car& car, const T& ax, const T& ay) {
  const T half = 0.5 * car.mass * gravity;
  const T pitch = car.mass * ax * car.cg_height / wheelbase(car);
  const T front = clamp(0.5 * (front_weight(car) - pitch), 0.0, half);
  const T rear = clamp(0.5 * (rear_weight(car) + pitch), 0.0, half);
  const T roll = car.mass * ay * car.cg_height / car.track_width;
  // An axle whose inner wheel has lifted leaves the rest of the roll to the other one.
  const T front_share = clamp(car.front_roll_stiffness_share * roll, -front, front);
  const T rear_roll = clamp(roll - front_share, -rear, rear);
  const T front_roll = clamp(front_share + ((roll - front_share) - rear_roll), -front, front);
  return {front - front_roll, front + front_roll, rear - rear_roll, rear + rear_roll};
}

/// Everything about the four contacts; arrays, so that the compiler can work on several at once.
template <class T>
struct Wheels {
  Wheelwise<T> cosine, sine;  ///< of the wheels' angles against the body
  Wheelwise<T> v_x, v_y;      ///< of the wheel centres, expressed in T [m/s]
  Wheelwise<T> load;          ///< [N]
  Wheelwise<T> drag;          ///< force over sliding velocity [N s/m]
  Wheelwise<T> F_x, F_y;      ///< expressed in T [N]
};

/// @param middle  of the road wheels, between the two front ones
template <class T, class Car>
inline Wheels<T> wheels_of(const Car& car, const StateVector<T>& state_vector,
                           const Turn<T>& middle, const Wheelwise<T>& grip) {
  using F = StateVector<T>;
  Wheels<T> wheels;
  wheels.load = wheel_loads<T>(car, state_vector[F::ax], state_vector[F::ay]);
  // Ackermann: the axes of the front wheels meet on the rear axle's line, so the inner one turns
  // more.
  const T half = half_track(car);
  const Wheelwise<T> x{car.cg_to_front_axle, car.cg_to_front_axle, -car.cg_to_rear_axle,
                       -car.cg_to_rear_axle};
  const Wheelwise<T> y{half, -half, half, -half};
  wheels.cosine = {1.0, 1.0, 1.0, 1.0};
  wheels.sine = {0.0, 0.0, 0.0, 0.0};
  for (const std::size_t i : {front_left, front_right}) {
    const T along = wheelbase(car) * middle.cosine - y[i] * middle.sine;
    const T across = wheelbase(car) * middle.sine;
    const T scale = 1.0 / sqrt(along * along + across * across);
    wheels.cosine[i] = along * scale;
    wheels.sine[i] = across * scale;
  }
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T v_x = state_vector[F::vx] - state_vector[F::yaw_rate] * y[i];
    const T v_y = state_vector[F::vy] + state_vector[F::yaw_rate] * x[i];
    wheels.v_x[i] = wheels.cosine[i] * v_x + wheels.sine[i] * v_y;
    wheels.v_y[i] = wheels.cosine[i] * v_y - wheels.sine[i] * v_x;
    const T slip_x = wheels.v_x[i] - car.wheel_radius * state_vector[F::wheel + i];
    const T drag = sliding_drag<T>(car.tyre, slip_x * slip_x + wheels.v_y[i] * wheels.v_y[i],
                                   v_x * v_x + v_y * v_y, wheels.load[i], grip[i]);
    wheels.drag[i] = drag;
    wheels.F_x[i] = -drag * slip_x;
    wheels.F_y[i] = -drag * wheels.v_y[i];
  }
  return wheels;
}

/// Torque of motor and road that turns a wheel against its brake [N m].
template <class T, class Car>
inline T turning_torque(const Car& car, std::size_t wheel, const T& motor, const T& F_x) {
  return motor_share(car, wheel) * motor - car.wheel_radius * F_x;
}

template <class T, class Car, class Command>
inline void actuator_rates(const Car& car, const StateVector<T>& state_vector,
                           const Command& command, StateVector<T>& rate) {
  using F = StateVector<T>;
  rate[F::steering] = clamp((command.steering - state_vector[F::steering]) / car.steering_lag,
                            -car.steering_rate, car.steering_rate);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    rate[F::brake + i] = (command.brake_torque[i] - state_vector[F::brake + i]) / car.brake_lag;
  }
  rate[F::motor] = (command.motor_torque - state_vector[F::motor]) / car.motor_lag;
}

/// Rates of the wheels' spin.
/// @param rolls  0 for a locked wheel
template <class T, class Car>
inline void wheel_rates(const Car& car, const StateVector<T>& state_vector, const Wheels<T>& wheels,
                        const Wheelwise<T>& rolls, StateVector<T>& rate) {
  using F = StateVector<T>;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T inertia = wheel_inertia(car, i);
    const T brake = clamp(brake_stiffness * inertia * state_vector[F::wheel + i],
                          -state_vector[F::brake + i], state_vector[F::brake + i]);
    rate[F::wheel + i] =
        rolls[i] *
        (motor_share(car, i) * state_vector[F::motor] - brake - car.wheel_radius * wheels.F_x[i]) /
        inertia;
  }
}

/// Rates of the body's place and velocity under a force [N], expressed in B, and a torque [N m].
template <class T, class Car>
inline void body_motion(const Car& car, const StateVector<T>& state_vector, const Turn<T>& heading,
                        const Pair<T>& force, const T& torque, StateVector<T>& rate) {
  using F = StateVector<T>;
  const T vx = state_vector[F::vx];
  const T vy = state_vector[F::vy];
  rate[F::x] = heading.cosine * vx - heading.sine * vy;
  rate[F::y] = heading.sine * vx + heading.cosine * vy;
  rate[F::yaw] = state_vector[F::yaw_rate];
  rate[F::vx] = force.x / car.mass + state_vector[F::yaw_rate] * vy;
  rate[F::vy] = force.y / car.mass - state_vector[F::yaw_rate] * vx;
  rate[F::yaw_rate] = torque / car.yaw_inertia;
}

/// The same under the forces of the wheels and the air.
/// @return  the force on the body [N]
template <class T, class Car>
inline Pair<T> body_rates(const Car& car, const StateVector<T>& state_vector,
                          const Wheels<T>& wheels, const Turn<T>& heading, StateVector<T>& rate) {
  using F = StateVector<T>;
  Pair<T> force;
  T torque = 0.0;
  const T half = half_track(car);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T F_x = wheels.cosine[i] * wheels.F_x[i] - wheels.sine[i] * wheels.F_y[i];
    const T F_y = wheels.sine[i] * wheels.F_x[i] + wheels.cosine[i] * wheels.F_y[i];
    const T x = is_front(i) ? T(car.cg_to_front_axle) : T(-car.cg_to_rear_axle);
    const T y = is_left(i) ? half : -half;
    force.x = force.x + F_x;
    force.y = force.y + F_y;
    torque += x * F_y - y * F_x;
  }
  const T vx = state_vector[F::vx];
  const T vy = state_vector[F::vy];
  const T air = air_drag(car) * sqrt(vx * vx + vy * vy);
  force = {force.x - air * vx, force.y - air * vy};
  body_motion(car, state_vector, heading, force, torque, rate);
  return force;
}

/// Rates of the acceleration that the wheel loads answer to.
template <class T, class Car>
inline void load_rates(const Car& car, const StateVector<T>& state_vector, const Pair<T>& force,
                       StateVector<T>& rate) {
  using F = StateVector<T>;
  rate[F::ax] = (force.x / car.mass - state_vector[F::ax]) / car.load_transfer_lag;
  rate[F::ay] = (force.y / car.mass - state_vector[F::ay]) / car.load_transfer_lag;
}

/// Whether the brakes hold a slow car: they can take more than its motor gives.
template <class T, class Car>
inline auto is_held(const Car& car, const StateVector<T>& state_vector) {
  using F = StateVector<T>;
  constexpr double least = 50.0;  // [N m]: brakes that merely linger do not hold
  const T brakes = state_vector[F::brake] + state_vector[F::brake + 1] +
                   state_vector[F::brake + 2] + state_vector[F::brake + 3];
  return hypot(state_vector[F::vx], state_vector[F::vy]) < hold_speed &&
         abs(state_vector[F::yaw_rate]) * wheelbase(car) < hold_speed &&
         brakes > abs(state_vector[F::motor]) + least;
}

}  // namespace saca::vehicle::equations

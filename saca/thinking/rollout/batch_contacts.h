#pragma once

#include <array>
#include <cstddef>

#include "saca/thinking/rollout/batch_lane.h"

/// The tyres' forces in a step of the batch, for a number type `T`: those of the scalar model, with
/// less work and four wheels side by side. Not part of the library's interface.
namespace saca::rollout::lanes {

using vehicle::num_wheels;
using vehicle::equations::Pair;
using vehicle::equations::Turn;
using vehicle::equations::Wheelwise;

/// The four contacts. Rear wheels point along the body.
template <class T>
struct WheelContacts {
  std::array<Turn<T>, 2> front;  ///< of the front wheels against the body
  Wheelwise<T> v_x;              ///< of the wheel centres, expressed in T [m/s]
  Wheelwise<T> F_x, F_y;         ///< expressed in T [N]
  Wheelwise<T> slope;            ///< how -F_x grows with the wheel's sliding velocity [N s/m]
};

/// Velocities of the wheel centres, expressed in B: along for left and right, across for front and
/// rear [m/s].
template <class T>
struct CentreVelocities {
  std::array<T, 2> x, y;
};
template <class T>
inline CentreVelocities<T> centre_velocities(
    const CarLane<T>& car, const vehicle::equations::StateVector<T>& state_vector) {
  using F = vehicle::equations::StateVector<T>;
  const T round = car.half_track * state_vector[F::yaw_rate];
  return {{state_vector[F::vx] - round, state_vector[F::vx] + round},
          {state_vector[F::vy] + car.cg_to_front_axle * state_vector[F::yaw_rate],
           state_vector[F::vy] - car.cg_to_rear_axle * state_vector[F::yaw_rate]}};
}

/// cos(y) over y^2 in [0, pi^2], by interpolation at Chebyshev nodes: error 5e-5, enough for a
/// slope.
constexpr std::array<double, 5> fall_curve{0.999958232, -0.499788066, 0.0414934584, -0.00133885088,
                                           1.87708309e-05};

/// `f` for each wheel. What is done in several rounds has four independent operations side by side.
template <class F>
inline void for_wheels(const F& f) {
  f(0);
  f(1);
  f(2);
  f(3);
}

/// `sliding_drag` for all wheels, and how the force along each grows, from one evaluation of the
/// tyre's curve.
template <class T>
struct Sliding {
  Wheelwise<T> drag;   ///< force over sliding velocity [N s/m]
  Wheelwise<T> slope;  ///< force along the wheel over its sliding velocity along, as it grows
};
template <class T>
inline Sliding<T> sliding(const TyreLane<T>& tyre, const Wheelwise<T>& along,
                          const Wheelwise<T>& across, const Wheelwise<T>& speed_squared,
                          const Wheelwise<T>& load, const T& grip) {
  using vehicle::equations::MagicCurve;
  using vehicle::equations::polynomial;
  constexpr double floor = vehicle::slip_speed_floor * vehicle::slip_speed_floor;
  Wheelwise<T> size, zz, slipping, root, w_over_z, y_over_z, yy, ratio;
  Sliding<T> result;
  for_wheels([&](std::size_t i) {
    const T peak = vehicle::equations::peak_friction<T>(tyre, load[i], grip);
    const T rise = tyre.rise / T(peak * sqrt(max(speed_squared[i], floor)));  // z over velocity
    slipping[i] = along[i] * along[i] + across[i] * across[i];
    zz[i] = rise * rise * slipping[i];
    size[i] = peak * load[i] * rise;
  });
  for_wheels([&](std::size_t i) {
    root[i] = sqrt(1.0 + zz[i]);
    w_over_z[i] = 1.0 / (1.0 + root[i]);
  });
  for_wheels([&](std::size_t i) {
    y_over_z[i] = tyre.twice_shape * w_over_z[i] *
                  polynomial<T>(MagicCurve<T>::arc, (root[i] - 1.0) * w_over_z[i]);
    yy[i] = zz[i] * y_over_z[i] * y_over_z[i];
  });
  for_wheels([&](std::size_t i) {
    ratio[i] = y_over_z[i] * polynomial<T>(MagicCurve<T>::wave, yy[i]);
    result.drag[i] = size[i] * ratio[i];
  });
  for_wheels([&](std::size_t i) {
    // d sin(C atan z) / dz = C cos(C atan z) / (1 + z^2)
    const T fall = tyre.shape * polynomial<T>(fall_curve, yy[i]) - (1.0 + zz[i]) * ratio[i];
    result.slope[i] = result.drag[i] + along[i] * along[i] * (size[i] * fall) /
                                           T((1.0 + zz[i]) * max(slipping[i], 1e-9));
  });
  return result;
}

/// As `wheels_of` in the vehicle's equations.
template <class T>
inline WheelContacts<T> contacts_of(const CarLane<T>& car,
                                    const vehicle::equations::StateVector<T>& state_vector,
                                    const Turn<T>& middle, const T& grip) {
  using F = vehicle::equations::StateVector<T>;
  WheelContacts<T> contacts;
  const CentreVelocities<T> v_B = centre_velocities(car, state_vector);
  const T forth = car.wheelbase * middle.cosine;
  const T across = car.wheelbase * middle.sine;
  const T aside = car.half_track * middle.sine;
  for (const std::size_t i : {vehicle::front_left, vehicle::front_right}) {
    const T along = vehicle::equations::is_left(i) ? T(forth - aside) : T(forth + aside);
    const T scale = 1.0 / sqrt(along * along + across * across);
    contacts.front[i] = {along * scale, across * scale};
  }
  Wheelwise<T> slip_x, v_y, speed_squared;
  for_wheels([&](std::size_t i) {
    const T& vx = v_B.x[i % 2];
    const T& vy = v_B.y[i / 2];
    contacts.v_x[i] = vx;
    v_y[i] = vy;
    if (vehicle::equations::is_front(i)) {
      const Turn<T>& turn = contacts.front[i];
      contacts.v_x[i] = turn.cosine * vx + turn.sine * vy;
      v_y[i] = turn.cosine * vy - turn.sine * vx;
    }
    slip_x[i] = contacts.v_x[i] - car.wheel_radius * state_vector[F::wheel + i];
    speed_squared[i] = vx * vx + vy * vy;
  });
  const Wheelwise<T> load =
      vehicle::equations::wheel_loads<T>(car, state_vector[F::ax], state_vector[F::ay]);
  const Sliding<T> slides = sliding<T>(car.tyre, slip_x, v_y, speed_squared, load, grip);
  for_wheels([&](std::size_t i) {
    contacts.F_x[i] = -slides.drag[i] * slip_x[i];
    contacts.F_y[i] = -slides.drag[i] * v_y[i];
  });
  contacts.slope = slides.slope;
  return contacts;
}

/// As `body_rates` in the vehicle's equations.
template <class T>
inline Pair<T> body_rates(const CarLane<T>& car,
                          const vehicle::equations::StateVector<T>& state_vector,
                          const WheelContacts<T>& contacts, const Turn<T>& heading,
                          vehicle::equations::StateVector<T>& rate) {
  using F = vehicle::equations::StateVector<T>;
  Wheelwise<T> F_x = contacts.F_x;  // now in B
  Wheelwise<T> F_y = contacts.F_y;
  for (std::size_t i = 0; i < 2; ++i) {
    const Turn<T>& turn = contacts.front[i];
    F_x[i] = turn.cosine * contacts.F_x[i] - turn.sine * contacts.F_y[i];
    F_y[i] = turn.sine * contacts.F_x[i] + turn.cosine * contacts.F_y[i];
  }
  const T left = F_x[vehicle::front_left] + F_x[vehicle::rear_left];
  const T right = F_x[vehicle::front_right] + F_x[vehicle::rear_right];
  const T front = F_y[vehicle::front_left] + F_y[vehicle::front_right];
  const T rear = F_y[vehicle::rear_left] + F_y[vehicle::rear_right];
  const T vx = state_vector[F::vx];
  const T vy = state_vector[F::vy];
  const T air = car.air_drag * hypot(vx, vy);
  const Pair<T> force{(left + right) - air * vx, (front + rear) - air * vy};
  const T torque =
      car.cg_to_front_axle * front - car.cg_to_rear_axle * rear + car.half_track * (right - left);
  vehicle::equations::body_motion<T>(car, state_vector, heading, force, torque, rate);
  return force;
}

}  // namespace saca::rollout::lanes

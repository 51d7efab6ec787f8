#pragma once

#include "saca/onboard/vehicle/abs.h"
#include "saca/onboard/vehicle/equations.h"

/// The deployed anti-lock brake, for any number type: `abs.h` has it for one car in `double`. `Car`
/// as in `equations.h`; `State` and `Abs` have the fields of `VehicleState` and `AbsState`.
namespace saca::vehicle::equations {

// Brakes follow commands 0.1 s late, and a braking car's rear wheels unload: each wheel gets what
// it can take both now and once the load has moved.
template <class T, class Car>
inline Wheelwise<T> lasting_loads(const Car& car, const T& ax, const T& ay, const T& deceleration) {
  Wheelwise<T> now = wheel_loads<T>(car, ax, ay);
  const Wheelwise<T> then = wheel_loads<T>(car, -deceleration, ay);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    now[i] = min(now[i], then[i]);
  }
  return now;
}

// Part of the brake torque that slows the wheel itself and never reaches the road [N m].
template <class T, class Car>
inline T slowing_torque(const Car& car, std::size_t wheel, const T& deceleration) {
  return wheel_inertia(car, wheel) * deceleration / car.wheel_radius;
}

// The estimate of the speed ahead, `dt` on: acceleration integrated; while nothing brakes or drives
// the wheels of the axle with less of the motor, they roll and tell the speed itself.
// @param trusted  how far rolling wheels are believed within `dt`, in [0, 1]
template <class T, class Car, class State>
inline T followed_speed(const Car& car, const State& state, double dt, double trusted,
                        const T& speed) {
  constexpr double rolling = 20.0;  // [N m]: of both: hardly any slip
  const auto front = front_rolls(car);
  const auto of_axle = [&](const auto& values) {
    return select(front, values[front_left] + values[front_right],
                  values[rear_left] + values[rear_right]);
  };
  const T share = select(front, motor_share(car, front_left), motor_share(car, rear_left));
  const T turning = of_axle(state.brake_torque) + 2.0 * share * abs(state.motor_torque);
  const T followed = speed + dt * (state.a_B.x + state.yaw_rate * state.v_B.y);
  const auto tells = turning < rolling;
  if (!any(tells)) {
    return max(0.0, followed);
  }
  const T wheels =
      0.5 * of_axle(state.wheel_speed) * car.wheel_radius * select(front, cos(state.steering), 1.0);
  return max(0.0, select(tells, followed + trusted * (wheels - followed), followed));
}

// Slip of each wheel along its own plane, against a speed that does not come from the wheels.
template <class T, class Car, class State>
inline Wheelwise<T> estimated_slip(const Car& car, const State& state, const T& speed) {
  Wheelwise<T> slip{};
  const Turn<T> turn = turn_by<T>(state.steering);
  const T half = half_track(car);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T x = is_front(i) ? T(car.cg_to_front_axle) : T(-car.cg_to_rear_axle);
    const T y = is_left(i) ? half : -half;
    const T vx = speed - state.yaw_rate * y;
    const T vy = state.v_B.y + state.yaw_rate * x;
    const T ahead = is_front(i) ? turn.cosine * vx + turn.sine * vy : vx;
    slip[i] = (ahead - car.wheel_radius * state.wheel_speed[i]) / max(ahead, slip_speed_floor);
  }
  return slip;
}

// How far what is smoothed over a time goes to a new value, `dt` after the last call.
inline double smoothing_share(const AbsState& /*abs*/, double dt, double time) {
  return std::min(1.0, dt / time);
}

// What a wheel's slip says about its share of the torque. Gains found by simulation over 5 to 25
// m/s and grip 0.3 to 1.0 with the estimate wrong by up to 20 %; they have no other source.
template <class T>
struct Correction {
  T learning;  // growth of the share [1/s]
  T too_much;  // slip over what is wanted, as a share of that, >= 0
};
template <class T, class Wanted, class Mask>
inline Correction<T> correction(const T& slip, const T& slip_growth, const Wanted& wanted_slip,
                                const T& share, const Mask& all_wanted) {
  constexpr double lead = 0.06;  // [s] by which slip is foreseen, for the brakes' delay
  constexpr double raise = 0.5;  // [1/s] share won back at no slip
  constexpr double lower = 4.0;  // [1/s] share given up at twice the wanted slip
  const T growth = clamp(slip_growth, -20.0, 20.0);
  const T foreseen = slip + lead * growth;
  const T excess = clamp(foreseen / wanted_slip - 1.0, -1.0, 2.0);
  // Little slip means unused grip only where all of it is wanted; else the model's torque will do.
  const T rest = select(all_wanted, -raise * excess, raise * (1.0 - share));
  return {select(excess > 0.0, -lower * excess, rest), max(0.0, excess)};
}

// The corrections for all wheels in one call, `dt` after the last one; notes the slips.
// @param wanted  share of the grip, in [0, 1]
template <class T, class Mask>
inline std::array<Correction<T>, num_wheels> next_corrections(AbsState& abs,
                                                              const Wheelwise<T>& slips,
                                                              const T& wanted_slip,
                                                              const Mask& all_wanted,
                                                              const T& /*wanted*/, double dt) {
  std::array<Correction<T>, num_wheels> corrections;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    corrections[i] = correction<T>(slips[i], (slips[i] - abs.slip[i]) / dt, wanted_slip,
                                   abs.share[i], all_wanted);
  }
  abs.slip = slips;
  return corrections;
}

template <class T, class Car, class State, class Abs>
inline Wheelwise<T> deployed_brakes(const Car& car, const State& state, const T& deceleration,
                                    const T& grip, double dt, Abs& abs) noexcept {
  constexpr double trust = 0.01;            // [s] within which rolling wheels are believed
  constexpr double model_share = 0.95;      // of the estimated peak: where the controller starts
  constexpr double wanted_dry_slip = 0.10;  // at grip 1: 96 % of the peak force, on its safe side
  constexpr double release = 0.35;          // share released at once at twice the wanted slip
  constexpr double least_speed = 1.0;       // [m/s] below it slip means nothing and wheels may lock

  abs.speed = followed_speed<T>(car, state, dt, smoothing_share(abs, dt, trust), abs.speed);
  const Wheelwise<T> slips = estimated_slip<T>(car, state, abs.speed);
  const T most = grip * gravity;
  const Wheelwise<T> loads =
      lasting_loads<T>(car, state.a_B.x, state.a_B.y, min(deceleration, most));
  const T wanted_slip = wanted_dry_slip * grip;
  const T wanted = min(deceleration / most, model_share);
  const auto all_wanted = deceleration >= model_share * most;

  const std::array<Correction<T>, num_wheels> corrections =
      next_corrections<T>(abs, slips, wanted_slip, all_wanted, wanted, dt);
  Wheelwise<T> torque{};
  for (std::size_t i = 0; i < num_wheels; ++i) {
    abs.share[i] = clamp(abs.share[i] + dt * corrections[i].learning, 0.2, 1.4);
    const T now =
        select(abs.speed < least_speed, 1.0, abs.share[i] - release * corrections[i].too_much);
    const T full = wanted * (grip * loads[i] * car.wheel_radius + slowing_torque<T>(car, i, most));
    torque[i] = max(0.0, now) * full;
  }
  return torque;
}

}  // namespace saca::vehicle::equations

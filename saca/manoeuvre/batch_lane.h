#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "saca/manoeuvre/equations.h"

/// What the batch's kernels know of a drive under way, for a number type `T`: `float`, as one drive
/// is written down; or a pack, as many drives lie side by side. Every member is a `T`, so a field
/// has the same place, counted in `T`s, in both. Not part of the library's interface.
namespace saca::manoeuvre::lanes {

/// A number that much is divided by, with its inverse: multiplying is quicker.
template <class T>
struct Divisor : T {
  T inverse;
};
template <>
struct Divisor<float> {
  float value;
  float inverse;
};
template <>
struct Divisor<double> {
  double value;
  double inverse;
  constexpr operator double() const { return value; }
};
constexpr double operator/(double dividend, const Divisor<double>& divisor) {
  return dividend * divisor.inverse;
}

template <class T>
struct TyreLane {
  T stiffness;
  Divisor<T> shape;
  T load_sensitivity;
  T per_newton;
  T peak_zz;  ///< z^2 of the magic formula at its peak
};
template <class T>
inline const T& per_newton(const TyreLane<T>& tyre) {
  return tyre.per_newton;
}

template <class T>
struct SwerveLane {
  T lag, frequency, damping, guard_from;
  Divisor<T> guard_width;
};

template <class T>
struct DriftLane {
  T turning, most_turning, gain, lead, front_release, rear_release, outer_release, motor_share,
      steering, slide_share, lock_speed;
};

template <class T>
struct TuningLane {
  SwerveLane<T> swerve;
  DriftLane<T> drift;
};

/// A `Car`, with what its equations derive from it.
template <class T>
struct CarLane {
  Divisor<T> mass, yaw_inertia, wheelbase, track_width, wheel_radius, front_wheel_inertia,
      rear_wheel_inertia, load_transfer_lag, steering_lag, brake_lag, motor_lag, peak_slip;
  T front_arm, rear_arm, half_track, mass_height, front_roll_share, front_weight, rear_weight,
      air_drag, steering_rate, steering_limit, brake_limit, motor_limit, front_motor_share,
      rear_motor_share, front_rolls, percussion_arm, driven_load;
  TyreLane<T> tyre;
  TuningLane<T> tuning;
};

template <class T>
inline const Divisor<T>& wheelbase(const CarLane<T>& car) {
  return car.wheelbase;
}
template <class T>
inline const T& half_track(const CarLane<T>& car) {
  return car.half_track;
}
template <class T>
inline const Divisor<T>& wheel_inertia(const CarLane<T>& car, std::size_t wheel) {
  return vehicle::equations::is_front(wheel) ? car.front_wheel_inertia : car.rear_wheel_inertia;
}
template <class T>
inline const T& motor_share(const CarLane<T>& car, std::size_t wheel) {
  return vehicle::equations::is_front(wheel) ? car.front_motor_share : car.rear_motor_share;
}
template <class T>
inline auto front_rolls(const CarLane<T>& car) {
  return car.front_rolls > 0.5;
}
template <class T>
inline const T& air_drag(const CarLane<T>& car) {
  return car.air_drag;
}
template <class T>
inline const T& front_weight(const CarLane<T>& car) {
  return car.front_weight;
}
template <class T>
inline const T& rear_weight(const CarLane<T>& car) {
  return car.rear_weight;
}
template <class T>
inline const T& percussion_arm(const CarLane<T>& car) {
  return car.percussion_arm;
}
template <class T>
inline const T& driven_load(const CarLane<T>& car) {
  return car.driven_load;
}
template <class T>
inline const Divisor<T>& peak_slip(const CarLane<T>& car, const T&) {
  return car.peak_slip;
}

template <class T>
struct ShiftLane {
  T start_d, start_v, jerk, ramp, first, second;
};
template <class T>
inline const T& jerk(const ShiftLane<T>& shift) {
  return shift.jerk;
}

template <class T>
struct AbsLane {
  T speed;
  std::array<T, vehicle::num_wheels> share, slip;
};

/// As `ControllerState`.
template <class T>
struct MemoryLane {
  ShiftLane<T> shift;
  T end_d, time, speed;
  AbsLane<T> abs;
  T recovered_for;
  struct Drift {
    T yaw_rate, yaw_acceleration;
  } drift;
};

/// What does not change. Masks are 1 where they hold, else 0.
template <class T>
struct FixedLane {
  CarLane<T> real, known;
  T grip, known_grip;
  T curvature;
  T rest, slower, drifts;  ///< masks
  T side;                  ///< of a drift: 1 to the left, -1 to the right
  T delay_share;           ///< of the next older slot, where the brakes' dead time lies between two
};

constexpr std::size_t num_slots = 32;  ///< of the brake line, each of one step

/// What changes with every step.
template <class T>
struct MovingLane {
  vehicle::equations::Flow<T> flow;  ///< in the frame of the lane at the start
  T lost_x, lost_y;                  ///< what rounding has left out of x and y
  std::array<T, 8> rate;             ///< of the last step: x, y, yaw, v_x, v_y, yaw rate, a_x, a_y
  T ax, ay;                          ///< acceleration at the last step
  T told_steering;
  T first;  ///< 1 before the first step, then 0
  MemoryLane<T> memory;
  std::array<std::array<T, vehicle::num_wheels>, num_slots> brake_line;
};

template <class T>
struct Lane {
  FixedLane<T> fixed;
  MovingLane<T> moving;
};

constexpr double step = 2e-3;  ///< [s]
constexpr int steps_per_pose = 5;

}  // namespace saca::manoeuvre::lanes

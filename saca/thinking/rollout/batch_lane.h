#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "saca/onboard/manoeuvre/equations.h"
#include "saca/onboard/vehicle/abs_equations.h"

/// What the batch's kernels know of a drive under way, for a number type `T`: `float`, as one drive
/// is written down; or a pack, as many drives lie side by side. Every member is a `T`, so a field
/// has the same place, counted in `T`s, in both. Not part of the library's interface.
namespace saca::rollout::lanes {

using namespace number;

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
  T twice_shape;
  T rise;  ///< stiffness over shape
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
  T cg_to_front_axle, cg_to_rear_axle, half_track, cg_height, front_roll_stiffness_share,
      front_weight, rear_weight, air_drag, steering_rate, steering_limit, brake_limit, motor_limit,
      front_motor_share, rear_motor_share, front_rolls, percussion_arm, driven_load;
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
inline T front_load(const CarLane<T>& car, const T& ax) {
  const T pitch = car.mass * ax * car.cg_height / car.wheelbase;
  return clamp(car.front_weight - pitch, 0.0, car.mass * vehicle::gravity);
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

/// As `LaneShift`: where it starts and ends, and when its jerk changes.
template <class T>
struct ShiftLane {
  T start_d, start_v, jerk;
  std::array<T, 4> change;  ///< [s]
  T end;                    ///< [s]
  T end_d;
};

/// As of a `LaneShift`. The jerk jumps up or down by one and the same amount, so what it has grown
/// to is a sum of powers of the time since each jump.
template <class T>
inline manoeuvre::equations::Lateral<T> at(const ShiftLane<T>& shift, T time) {
  const auto over = time > shift.end;
  if (all(over)) {
    return {shift.end_d, 0.0, 0.0};
  }
  const auto since = [&](const T& change) { return T(max(time - change, 0.0)); };
  const T begun = max(time, 0.0);
  T once = begun;
  T squared = begun * begun;
  T cubed = squared * begun;
  for (std::size_t i = 0; i < shift.change.size(); ++i) {
    const T t = since(shift.change[i]);
    const T tt = t * t;
    once = i < 2 ? T(once - t) : T(once + t);
    squared = i < 2 ? T(squared - tt) : T(squared + tt);
    cubed = i < 2 ? T(cubed - tt * t) : T(cubed + tt * t);
  }
  const T d = shift.start_d + shift.start_v * time + (1.0 / 6.0) * shift.jerk * cubed;
  return {select(over, shift.end_d, d),
          select(over, 0.0, shift.start_v + 0.5 * shift.jerk * squared),
          select(over, 0.0, shift.jerk * once)};
}

/// Numbers that the scalar model's controllers derive from two calls are half of its 1 ms old; of
/// two calls `dt` apart, this share of a growth's own growth in `dt` is missing to that.
constexpr double newer(double dt) {
  return 0.5 * (1.0 - vehicle::usual_step / dt);
}

template <class T>
struct AbsLane {
  T speed;
  std::array<T, vehicle::num_wheels> share, slip;
  std::array<T, vehicle::num_wheels> growth;  ///< of the slip, when last called; 0: not known
};

/// As for `AbsState`. The first call after a pause knows no slip before, so it takes all of it for
/// growth: for 1 ms, not for a longer step.
template <class T, class Mask>
inline std::array<vehicle::equations::Correction<T>, vehicle::num_wheels> next_corrections(
    AbsLane<T>& abs, const vehicle::equations::Wheelwise<T>& slips, const T& wanted_slip,
    const Mask& all_wanted, const T& wanted, double dt) {
  using vehicle::num_wheels;
  std::array<vehicle::equations::Correction<T>, num_wheels> result;
  const Divisor<T> divisor{wanted_slip, 1.0 / wanted_slip};
  const auto corrected = [&](std::size_t i, const T& growth) {
    return vehicle::equations::correction<T>(slips[i], growth, divisor, abs.share[i], all_wanted);
  };
  const auto known = [](const T& value) { return value > 0.0 || value < 0.0; };
  auto usual = wanted <= 0.0;  // or does not brake: nobody asks
  usual = usual || (known(abs.slip[0]) && known(abs.slip[1]) && known(abs.slip[2]) &&
                    known(abs.slip[3]) && known(abs.growth[0]) && known(abs.growth[1]) &&
                    known(abs.growth[2]) && known(abs.growth[3]));
  const bool all_usual = all(usual);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const T growth = (slips[i] - abs.slip[i]) / dt;
    T last = abs.growth[i];
    if (!all_usual) {
      last = select(known(last), last, growth);
    }
    result[i] = corrected(i, growth + newer(dt) * (growth - last));
    abs.growth[i] = growth;
  }
  for (std::size_t i = 0; i < num_wheels && !all_usual; ++i) {
    const auto again = known(abs.slip[i]);
    const auto first = corrected(i, slips[i] / vehicle::usual_step);
    const auto then = corrected(i, 0.0);
    const double share = vehicle::usual_step / dt;
    result[i] = {
        select(again, result[i].learning, then.learning + share * (first.learning - then.learning)),
        select(again, result[i].too_much,
               then.too_much + share * (first.too_much - then.too_much))};
    abs.growth[i] = select(again, abs.growth[i], 0.0);
  }
  abs.slip = slips;
  return result;
}

/// As `DriftState`.
template <class T>
struct DriftMemoryLane {
  T yaw_rate, yaw_acceleration;
  T growth;  ///< of the yaw rate, when last called
};
template <class T>
inline T turning_growth(DriftMemoryLane<T>& memory, const T& yaw_rate, double dt) {
  const T growth = (yaw_rate - memory.yaw_rate) / dt;
  const T last = memory.growth;
  memory.growth = growth;
  memory.yaw_rate = yaw_rate;
  return growth + newer(dt) * (growth - last);
}

/// What is smoothed goes as far in a step as in calls 1 ms apart.
inline double smoothed(double dt, double time) {
  return 1.0 - std::pow(1.0 - vehicle::usual_step / time, dt / vehicle::usual_step);
}
template <class T>
inline double smoothing_share(const AbsLane<T>& /*abs*/, double dt, double time) {
  return smoothed(dt, time);
}
template <class T>
inline double smoothing_share(const DriftMemoryLane<T>& /*memory*/, double dt, double time) {
  return smoothed(dt, time);
}

/// As `ControllerState`.
template <class T>
struct MemoryLane {
  ShiftLane<T> shift;
  T end_d, time, speed;
  AbsLane<T> abs;
  T recovered_for;
  DriftMemoryLane<T> drift;
};

/// What does not change. Masks are 1 where they hold, else 0.
template <class T>
struct FixedLane {
  CarLane<T> real, known;
  T grip, known_grip;
  T curvature;
  T rest, slower;  ///< masks
  T strength;      ///< of a stop, in (0, 1]
  T side;          ///< of a drift: 1 to the left, -1 to the right
  T delay_share;   ///< of the next older slot, where the brakes' dead time lies between two
};

constexpr std::size_t num_slots = 32;  ///< of the brake line, each of one step

/// What changes with every step.
template <class T>
struct MovingLane {
  vehicle::equations::StateVector<T> state_vector;  ///< in the frame of the lane at the start
  T lost_x, lost_y;                                 ///< what rounding has left out of x and y
  std::array<T, 8> rate;  ///< of the last step: x, y, yaw, v_x, v_y, yaw rate, a_x, a_y
  T ax, ay;               ///< acceleration at the last step
  T command_steering;
  T first;  ///< 1 before the first step, then 0
  MemoryLane<T> memory;
  std::array<std::array<T, vehicle::num_wheels>, num_slots> brake_line;
};

template <class T>
struct Lane {
  FixedLane<T> fixed;
  MovingLane<T> moving;
};

/// What drives side by side have in common: the same controller, and a step that is short enough
/// for it.
enum class Kind : std::uint8_t { keeps_speed, brakes, drifts };
constexpr std::size_t num_kinds = 3;

constexpr double pose_step = 0.01;  ///< [s]
constexpr int steps_per_pose(Kind kind) {
  return kind == Kind::keeps_speed ? 2 : kind == Kind::brakes ? 3 : 4;
}
constexpr double step_of(Kind kind) {
  return pose_step / steps_per_pose(kind);
}

}  // namespace saca::rollout::lanes

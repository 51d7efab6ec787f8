#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace saca::danger {

/// Acceleration of the centre of mass, expressed along and across its course.
struct Acceleration {
  double along = 0.0;   ///< [m/s^2], forward
  double across = 0.0;  ///< [m/s^2], to the left
};

/// The accelerations that a car can take at one speed: a disc cut by the motor and by the steering.
struct Limits {
  double speed = 0.0;   ///< [m/s], >= 0; 0: the car stays stopped, and all that follows is 0
  double disc = 0.0;    ///< of the acceleration's size: grip x g [m/s^2]
  double drive = 0.0;   ///< of `along` [m/s^2], <= disc
  double across = 0.0;  ///< of the size of `across` [m/s^2], <= disc
  // What follows from them, kept because it is needed in every cell.
  double per_speed = 0.0;      ///< 1 / speed; 0 when stopped [s/m]
  double across_driven = 0.0;  ///< largest size of `across` that leaves the whole drive [m/s^2]
  double braked_across = 0.0;  ///< braking left at the largest `across` [m/s^2]
  double driven_across = 0.0;  ///< drive left at the largest `across` [m/s^2]
  double course_rate = 0.0;    ///< largest size of course' [rad/s]

  /// Largest fall of the value's rate by the inputs, for one-sided slopes over course and speed:
  /// max over the admissible inputs of -(along x p_speed + across x p_course / speed), each slope
  /// from the side towards which the input moves the state. Not below 0.
  template <class N>
  [[nodiscard]] N gain(const N& course_left, const N& course_right, const N& speed_left,
                       const N& speed_right) const;
};

/// What drives in the avoidance problem: a point with course and speed whose body's axis is its
/// course (no sideslip), x' = v cos(course) - obstacle_speed, y' = v sin(course), course' = across
/// / v, v' = along, in the frame of an obstacle that moves along x at constant speed and course.
///
/// Inputs avoid: along^2 + across^2 <= (grip g)^2, along <= drive_share grip g, |across| <=
/// tightest_curvature v^2. A car that has stopped stays stopped: at v = 0 no input acts, so that
/// |course'| <= tightest_curvature v goes to 0 and nothing is divided by 0.
///
/// State: x, y [m], course [rad], speed [m/s] of the ego's centre of mass.
struct Avoidance {
  static constexpr std::size_t dimensions = 4;

  double grip = 0.9;                  ///< [-], > 0
  double tightest_curvature = 0.235;  ///< [1/m], > 0
  double drive_share = 0.48;          ///< of grip g, in [0, 1]
  double obstacle_speed = 0.0;        ///< along x [m/s]

  struct Row;
  [[nodiscard]] Row row(const std::array<double, 4>& state) const;
};

/// Likewise beside a straight road edge along x, where x does not matter. State: y, course, speed.
struct EdgeAvoidance {
  static constexpr std::size_t dimensions = 3;

  Avoidance car;  ///< its obstacle_speed is not used

  struct Row;
  [[nodiscard]] Row row(const std::array<double, 3>& state) const;
};

/// @throws ContractViolation  if the speed is < 0 or a number of `car` is out of its range
[[nodiscard]] Limits limits_at(const Avoidance& car, double speed);

/// The admissible input that lets the value fall fastest; the smallest such one across.
/// @param gradient  of the value over x, y, course and speed
[[nodiscard]] Acceleration best_input(const Avoidance& car, double speed,
                                      const std::array<double, 4>& gradient);

/// The same problem at another grip: it runs in the same places, only slower or faster.
///
/// With c = sqrt(grip / other grip), a motion at `grip` with speeds v and obstacle_speed is one at
/// the other grip with speeds v / c, traversed in c times the time: curvature and the shares stay.
/// So V at `grip`, speed v and horizon T is V of `system` at speed x `speed_factor` and horizon T x
/// `time_factor`; x, y and course are the same.
struct ScaledAvoidance {
  Avoidance system;
  double speed_factor = 1.0;
  double time_factor = 1.0;
};
[[nodiscard]] ScaledAvoidance scaled_to(const Avoidance& system, double grip);

struct Avoidance::Row {
  double x_rate = 0.0;  ///< [m/s]
  double y_rate = 0.0;  ///< [m/s]
  Limits limits;
  std::array<int, 4> direction{};

  template <class N>
  [[nodiscard]] N hamiltonian(const N& x, const std::array<N, 4>& p) const {
    return upwind(x, p, p);
  }
  /// Exact for the discrete problem of moving to the neighbours: the least over the inputs, each
  /// with the differences of the sides towards which it moves the state. Monotone.
  template <class N>
  [[nodiscard]] N upwind(const N& x, const std::array<N, 4>& left,
                         const std::array<N, 4>& right) const {
    static_cast<void>(x);
    const N& p_x = x_rate < 0.0 ? left[0] : right[0];
    const N& p_y = y_rate < 0.0 ? left[1] : right[1];
    return N(x_rate) * p_x + N(y_rate) * p_y - limits.gain(left[2], right[2], left[3], right[3]);
  }
  template <class N>
  [[nodiscard]] std::array<N, 4> speeds(const N& x) const {
    static_cast<void>(x);
    return {N(std::abs(x_rate)), N(std::abs(y_rate)), N(limits.course_rate), N(limits.disc)};
  }
};

struct EdgeAvoidance::Row {
  double y_rate = 0.0;  ///< [m/s]
  Limits limits;
  std::array<int, 3> direction{};

  template <class N>
  [[nodiscard]] N hamiltonian(const N& y, const std::array<N, 3>& p) const {
    return upwind(y, p, p);
  }
  template <class N>
  [[nodiscard]] N upwind(const N& y, const std::array<N, 3>& left,
                         const std::array<N, 3>& right) const {
    static_cast<void>(y);
    const N& p_y = y_rate < 0.0 ? left[0] : right[0];
    return N(y_rate) * p_y - limits.gain(left[1], right[1], left[2], right[2]);
  }
  template <class N>
  [[nodiscard]] std::array<N, 3> speeds(const N& y) const {
    static_cast<void>(y);
    return {N(std::abs(y_rate)), N(limits.course_rate), N(limits.disc)};
  }
};

// Let q be the gain per size of `across`, s that per braking or per driving. Over a disc of radius
// G the best gain is G r, r = sqrt(q^2 + s^2), at across = G q / r; beyond a limit of `across`, or
// of `along`, it is that of the corner which the limit cuts into the circle.
template <class N>
N Limits::gain(const N& course_left, const N& course_right, const N& speed_left,
               const N& speed_right) const {
  const N none(0.0);
  const N q = max(none, max(course_left, -course_right)) * N(per_speed);
  const N braking = max(none, speed_left);
  const N driving = max(none, -speed_right);
  const N disc_q = N(disc) * q;
  const N across_q = N(across) * q;

  const N r_braking = sqrt(q * q + braking * braking);
  const N braked = where_less(N(across) * r_braking, disc_q, braking * N(braked_across) + across_q,
                              N(disc) * r_braking);
  const N r_driving = sqrt(q * q + driving * driving);
  const N curved = where_less(N(across) * r_driving, disc_q, driving * N(driven_across) + across_q,
                              N(disc) * r_driving);
  const N driven = where_less(disc_q, N(across_driven) * r_driving,
                              driving * N(drive) + q * N(across_driven), curved);
  // Where one of two is no number, the maximum of some sets is the other: the two slopes that it
  // may pass over count nothing else.
  return max(braked, driven) + N(0.0) * (course_left - speed_left);
}

}  // namespace saca::danger

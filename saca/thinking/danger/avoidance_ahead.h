#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/grid.h"

namespace saca::danger {

/// The avoidance problem as it is seen from the ego, where few points go a long way: the danger is
/// always ahead, and what decides between left and right lies along one axis.
///
/// State: place of the obstacle's centre ahead and to the left of the ego's centre of mass [m], in
/// the frame of the ego's course; its x axis' direction there, `turned` [rad]; the ego's speed
/// [m/s]. With w = obstacle_speed and course' = across / v: ahead' = -v + w cos(turned) + left
/// course', left' = w sin(turned) - ahead course', turned' = -course', v' = along.
struct AvoidanceAhead {
  static constexpr std::size_t dimensions = 4;

  Avoidance car;

  struct Row;
  [[nodiscard]] Row row(const std::array<double, 4>& state) const;
};

/// State of AvoidanceAhead for one of Avoidance: x, y, course, speed.
[[nodiscard]] State seen_by_ego(const State& state);

/// Slopes over x, y, course and speed for those over ahead, left, turned and speed.
/// @param seen  state of AvoidanceAhead
[[nodiscard]] State slopes_in_obstacle_frame(const State& seen, const State& slopes);

struct AvoidanceAhead::Row {
  double ahead_rate = 0.0;  ///< without turning [m/s]
  double left_rate = 0.0;   ///< likewise
  double left = 0.0;        ///< [m]
  Limits limits;

  template <class N>
  [[nodiscard]] N hamiltonian(const N& ahead, const std::array<N, 4>& p) const {
    return upwind(ahead, p, p);
  }
  /// What the speed does and what turning does take each slope from the side to which they move
  /// the state by themselves: monotone.
  template <class N>
  [[nodiscard]] N upwind(const N& ahead, const std::array<N, 4>& lower,
                         const std::array<N, 4>& upper) const {
    const N& p_ahead = ahead_rate < 0.0 ? lower[0] : upper[0];
    const N& p_left = left_rate < 0.0 ? lower[1] : upper[1];
    const N before = max(N(0.0), ahead);
    const N behind = max(N(0.0), -ahead);
    const bool is_left = left > 0.0;
    const N turning_left = N(left) * (is_left ? upper[0] : lower[0]) - before * lower[1] +
                           behind * upper[1] - lower[2];
    const N turning_right = before * upper[1] - behind * lower[1] -
                            N(left) * (is_left ? lower[0] : upper[0]) + upper[2];
    return N(ahead_rate) * p_ahead + N(left_rate) * p_left -
           limits.gain(-turning_right, turning_left, lower[3], upper[3]);
  }
  template <class N>
  [[nodiscard]] std::array<N, 4> speeds(const N& ahead) const {
    return {N(std::abs(ahead_rate) + limits.course_rate * std::abs(left)),
            N(std::abs(left_rate)) + N(limits.course_rate) * abs(ahead), N(limits.course_rate),
            N(limits.disc)};
  }
};

}  // namespace saca::danger

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "saca/lab/levelset/flow.h"
#include "saca/thinking/danger/grid.h"

namespace saca::levelset {

/// Two cars of constant speed, one of which is to catch the other: a known answer for the solver.
///
/// State: the pursuer's position [m] and heading [rad] in the evader's frame (x ahead, y left):
///     x' = -v_e + v_p cos(heading) + a y,   y' = v_p sin(heading) - a x,   heading' = b - a.
/// The evader's turn rate a lowers V, the pursuer's b raises it.
/// Source: Mitchell, Bayen, Tomlin, A Time-Dependent Hamilton-Jacobi Formulation of Reachable Sets
/// for Continuous Dynamic Games, IEEE TAC 50(7), 2005, section V; the numbers are those of air3D in
/// Mitchell's Toolbox of Level Set Methods.
struct Air3d {
  static constexpr std::size_t dimensions = 3;

  double evader_speed = 5.0;       ///< v_e [m/s], >= 0
  double pursuer_speed = 5.0;      ///< v_p [m/s], >= 0
  double evader_turn_rate = 1.0;   ///< |a| at most [rad/s]
  double pursuer_turn_rate = 1.0;  ///< |b| at most [rad/s]
  double capture_radius = 5.0;     ///< caught within that distance [m]

  struct Row {
    double drift_x, drift_y;  ///< rates of x and y while the evader drives straight [m/s]
    double y;
    double evader_turn_rate, pursuer_turn_rate;

    template <class N>
    [[nodiscard]] N hamiltonian(const N& x, const std::array<N, 3>& p) const {
      using std::abs;
      const N by_evader = y * p[0] - x * p[1] - p[2];
      return drift_x * p[0] + drift_y * p[1] - evader_turn_rate * abs(by_evader) +
             pursuer_turn_rate * abs(p[2]);
    }

    template <class N>
    [[nodiscard]] std::array<N, 3> speeds(const N& x) const {
      using std::abs;
      return {N(std::abs(drift_x) + evader_turn_rate * std::abs(y)),
              std::abs(drift_y) + evader_turn_rate * abs(x),
              N(evader_turn_rate + pursuer_turn_rate)};
    }
  };

  [[nodiscard]] Row row(const std::array<double, 3>& x) const {
    return {pursuer_speed * std::cos(x[2]) - evader_speed, pursuer_speed * std::sin(x[2]), x[1],
            evader_turn_rate, pursuer_turn_rate};
  }
};

/// x in [-6, 20], y in [-10, 10] [m], heading periodic in [0, 2 pi) [rad].
[[nodiscard]] danger::Grid air3d_grid(int x_points, int y_points, int heading_points);

/// h: capture radius less the distance [m].
/// @param state  (3)
[[nodiscard]] double intrusion(const Air3d& game, std::span<const double> state);

/// Volume of {V >= 0} on a grid of three evenly spaced axes: along each line of points in the first
/// axis the length on which V, linear between points, is >= 0; the lines' lengths summed times the
/// spacings, those at the ends of open axes by half.
/// @param values  one per cell
template <class Real>
[[nodiscard]] double tube_volume(const danger::Grid& grid, std::span<const Real> values);

extern template double tube_volume(const danger::Grid&, std::span<const float>);
extern template double tube_volume(const danger::Grid&, std::span<const double>);

}  // namespace saca::levelset

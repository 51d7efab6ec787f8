#include "saca/lab/levelset/air3d.h"

#include <algorithm>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::levelset {
namespace {

/// Share of a stretch on which a value that goes linearly from one to the other is >= 0.
double share_caught(double left, double right) {
  if ((left >= 0.0) == (right >= 0.0)) {
    return left >= 0.0 ? 1.0 : 0.0;
  }
  return std::max(left, right) / std::abs(left - right);
}

/// How much of a spacing belongs to a point.
double width_of(const danger::Axis& axis, int point) {
  const bool at_end = point == 0 || point == axis.points - 1;
  return at_end && axis.edge != danger::Edge::periodic ? 0.5 : 1.0;
}

}  // namespace

danger::Grid air3d_grid(int x_points, int y_points, int heading_points) {
  return {{{.name = "x", .first = -6.0, .last = 20.0, .points = x_points},
           {.name = "y", .first = -10.0, .last = 10.0, .points = y_points},
           {.name = "heading",
            .first = 0.0,
            .last = 2.0 * std::numbers::pi,
            .points = heading_points,
            .edge = danger::Edge::periodic}}};
}

double intrusion(const Air3d& game, std::span<const double> state) {
  return game.capture_radius - std::hypot(state[0], state[1]);
}

template <class Real>
double tube_volume(const danger::Grid& grid, std::span<const Real> values) {
  expects(grid.axes.size() == 3, "three axes");
  expects(values.size() == danger::num_cells(grid), "one value per cell");
  const danger::Axis& x = grid.axes[0];
  const danger::Axis& y = grid.axes[1];
  const danger::Axis& z = grid.axes[2];
  const auto points = static_cast<std::size_t>(x.points);
  double sum = 0.0;
  for (std::size_t first = 0; first < values.size(); first += points) {
    double length = 0.0;
    for (std::size_t i = first; i + 1 < first + points; ++i) {
      length += share_caught(static_cast<double>(values[i]), static_cast<double>(values[i + 1]));
    }
    const danger::Cell cell = danger::cell_at(grid, first);
    sum += length * width_of(y, cell[1]) * width_of(z, cell[2]);
  }
  return sum * spacing(x, 0) * spacing(y, 0) * spacing(z, 0);
}

template double tube_volume(const danger::Grid&, std::span<const float>);
template double tube_volume(const danger::Grid&, std::span<const double>);

}  // namespace saca::levelset

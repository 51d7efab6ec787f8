#include "saca/thinking/danger/grid.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"

namespace saca::danger {
namespace {

constexpr int fewest_points = 4;  // differences reach over three neighbours

double evenly(const Axis& axis, double coordinate) {
  return axis.stretch > 0.0 ? std::asinh(coordinate / axis.stretch) : coordinate;
}

/// Of the evenly spaced number beneath the coordinate.
double even_spacing(const Axis& axis) {
  const int cells = axis.edge == Edge::periodic ? axis.points : axis.points - 1;
  return (evenly(axis, axis.last) - evenly(axis, axis.first)) / cells;
}

/// Its other axes are right by themselves.
std::optional<std::string> wrong_mirror(const Grid& grid, const Axis& axis) {
  if (axis.edge != Edge::mirrored) {
    return std::nullopt;
  }
  if (axis.first != 0.0) {
    return fmt::format("a mirrored axis begins at 0, got {}", axis.first);
  }
  if (!axis.turned) {
    return std::nullopt;
  }
  if (*axis.turned >= grid.axes.size() || grid.axes[*axis.turned].edge != Edge::periodic) {
    return fmt::format("`turned` names a periodic axis, got axis {}", *axis.turned + 1);
  }
  const Axis& other = grid.axes[*axis.turned];
  const double points_of_twice_first = 2.0 * other.first / spacing(other, 0);
  if (std::abs(points_of_twice_first - std::round(points_of_twice_first)) > 1e-6) {
    return fmt::format("the points of {} are to lie the same on both sides of 0", other.name);
  }
  return std::nullopt;
}

std::optional<std::string> wrong_axis(const Axis& axis) {
  if (axis.points < fewest_points) {
    return fmt::format("at least {} points, got {}", fewest_points, axis.points);
  }
  if (!std::isfinite(axis.first) || !std::isfinite(axis.last) || !(axis.last > axis.first)) {
    return fmt::format("first < last, got {} and {}", axis.first, axis.last);
  }
  if (!(axis.stretch >= 0.0 && std::isfinite(axis.stretch))) {
    return fmt::format("stretch >= 0, got {}", axis.stretch);
  }
  if (axis.edge == Edge::periodic && axis.stretch > 0.0) {
    return fmt::format("a periodic axis is even, got stretch {}", axis.stretch);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> broken_rule(const Grid& grid) {
  if (grid.axes.empty() || grid.axes.size() > max_dimensions) {
    return fmt::format("a grid has 1 to {} axes, got {}", max_dimensions, grid.axes.size());
  }
  for (const bool mirrors : {false, true}) {
    for (std::size_t d = 0; d < grid.axes.size(); ++d) {
      const Axis& axis = grid.axes[d];
      if (const auto problem = mirrors ? wrong_mirror(grid, axis) : wrong_axis(axis)) {
        return fmt::format("axis {} ({}): wanted {}", d + 1, axis.name, *problem);
      }
    }
  }
  return std::nullopt;
}

std::size_t num_cells(const Grid& grid) {
  std::size_t cells = 1;
  for (const Axis& axis : grid.axes) {
    cells *= static_cast<std::size_t>(axis.points);
  }
  return cells;
}

std::vector<std::size_t> strides(const Grid& grid) {
  std::vector<std::size_t> found;
  std::size_t stride = 1;
  for (const Axis& axis : grid.axes) {
    found.push_back(stride);
    stride *= static_cast<std::size_t>(axis.points);
  }
  return found;
}

Cell cell_at(const Grid& grid, std::size_t number) {
  Cell cell{};
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    const auto points = static_cast<std::size_t>(grid.axes[d].points);
    cell[d] = static_cast<int>(number % points);
    number /= points;
  }
  return cell;
}

State state_at(const Grid& grid, std::size_t number) {
  const Cell cell = cell_at(grid, number);
  State state{};
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    state[d] = coordinate(grid.axes[d], cell[d]);
  }
  return state;
}

std::string described(const Grid& grid, const State& state) {
  std::string text;
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    fmt::format_to(std::back_inserter(text), "{}{} = {:.4g}", d > 0 ? ", " : "", grid.axes[d].name,
                   state[d]);
  }
  return text;
}

double coordinate(const Axis& axis, int point) {
  const double even = evenly(axis, axis.first) + point * even_spacing(axis);
  return axis.stretch > 0.0 ? axis.stretch * std::sinh(even) : even;
}

double spacing(const Axis& axis, int point) {
  const double even = even_spacing(axis);
  return axis.stretch > 0.0
             ? axis.stretch * std::cosh(evenly(axis, axis.first) + point * even) * even
             : even;
}

double point_of(const Axis& axis, double coordinate) {
  const double point = (evenly(axis, coordinate) - evenly(axis, axis.first)) / even_spacing(axis);
  if (axis.edge != Edge::periodic) {
    return point;
  }
  const double wrapped = point - axis.points * std::floor(point / axis.points);
  return wrapped < axis.points ? wrapped : 0.0;  // rounding may bring it to the end itself
}

template <class Real>
std::vector<Real> sampled(const Grid& grid,
                          const std::function<double(std::span<const double>)>& function,
                          int threads, bool alike_last) {
  expects(!broken_rule(grid), "grid breaks no rule");
  expects(!alike_last || grid.axes.size() > 1, "more than one axis");
  std::vector<Real> values(num_cells(grid));
  const auto row = static_cast<std::size_t>(grid.axes[0].points);
  const std::size_t asked = alike_last ? strides(grid).back() : values.size();
  in_parallel(asked / row, threads, [&](std::size_t r) {
    for (std::size_t i = r * row; i < (r + 1) * row; ++i) {
      const State state = state_at(grid, i);
      values[i] = static_cast<Real>(function({state.data(), grid.axes.size()}));
    }
  });
  for (std::size_t i = asked; i < values.size(); ++i) {
    values[i] = values[i - asked];
  }
  return values;
}

template std::vector<float> sampled(const Grid&,
                                    const std::function<double(std::span<const double>)>&, int,
                                    bool);
template std::vector<double> sampled(const Grid&,
                                     const std::function<double(std::span<const double>)>&, int,
                                     bool);

}  // namespace saca::danger

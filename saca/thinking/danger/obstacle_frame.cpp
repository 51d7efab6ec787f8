#include "saca/thinking/danger/obstacle_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "saca/base/core/contract.h"

namespace saca::danger {
namespace {

/// All of per_ahead x ahead + per_left x left, left to both sides.
Axis spanning(const std::string& name, const Grid& grid, double per_ahead, double per_left) {
  const Axis& ahead = grid.axes[0];
  const double to_a_side = std::abs(per_left) * grid.axes[1].last;
  const auto [low, high] = std::minmax({per_ahead * ahead.first, per_ahead * ahead.last});
  return {.name = name,
          .first = low - to_a_side,
          .last = high + to_a_side,
          .points = std::max(ahead.points, grid.axes[1].points)};
}

}  // namespace

std::optional<View> view_of(const Solution& solved) {
  const auto problem = parse_avoidance_case(solved.problem, "problem");
  if (!problem.has_value()) {
    return std::nullopt;
  }
  const bool same = std::equal(solved.grid.axes.begin(), solved.grid.axes.end(),
                               problem.value().grid.axes.begin(), problem.value().grid.axes.end(),
                               [](const Axis& a, const Axis& b) { return a.name == b.name; });
  return same ? std::optional(problem.value().view) : std::nullopt;
}

ValueAt in_obstacle_frame(const ValueTable& table, View view) {
  expects(view != View::edge, "the view is of an obstacle");
  expects(table.grid().axes.size() == 4, "the table has four axes");
  return [&table, view](const State& state) { return table.at(grid_state(view, state)); };
}

std::vector<Axis> axes_in_obstacle_frame(const Grid& grid, double course) {
  expects(grid.axes.size() == 4, "the grid has four axes");
  const double c = std::cos(course);
  const double s = std::sin(course);
  Axis around = grid.axes[2];
  around.name = "course";
  return {spanning("x", grid, -c, s), spanning("y", grid, -s, -c), around, grid.axes[3]};
}

}  // namespace saca::danger

#pragma once

#include <optional>
#include <vector>

#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/grid.h"
#include "saca/thinking/danger/value_file.h"
#include "saca/thinking/danger/value_table.h"

/// Solved values beside an obstacle as its own frame has them, in whichever view they were solved.
namespace saca::danger {

/// The view in which a case was solved.
/// @return  nullopt: the file's problem is no avoidance case, or its grid has other axes
[[nodiscard]] std::optional<View> view_of(const Solution& solved);

/// The value of a state: x, y, course and speed in the obstacle's frame.
/// @param table  of that view's axes; must outlive what is returned
/// @throws ContractViolation  if the view is View::edge or the table has not four axes
[[nodiscard]] ValueAt in_obstacle_frame(const ValueTable& table, View view);

/// The open x, y and speed and the periodic course, in place of the axes of View::ego.
/// @param grid    of View::ego
/// @param course  at which x and y just span all that the grid holds [rad]
/// @throws ContractViolation  if the grid has not four axes
[[nodiscard]] std::vector<Axis> axes_in_obstacle_frame(const Grid& grid, double course);

}  // namespace saca::danger

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "saca/thinking/danger/grid.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::report {

/// How a coordinate is told to people: `factor` x the value in this unit.
struct ReadUnit {
  std::string unit;  ///< empty: not known
  double factor = 1.0;
};

/// By the axis' name: x, y, ahead, left [m]; course, heading, turned [deg]; speed, v [m/s].
[[nodiscard]] ReadUnit read_unit(std::string_view axis_name);

/// The coordinates in which a solution is shown: those of its grid; of what was solved as seen from
/// the ego, x, y, course and speed in the obstacle's frame.
/// @param course  at which x and y just span what the grid holds [rad]
[[nodiscard]] std::vector<danger::Axis> shown_axes(const danger::Solution& solved, double course);

/// What a page shows first.
struct ValueView {
  std::string title;
  danger::State others{};  ///< shown coordinates from the third on
  std::size_t time = 0;    ///< number of a snapshot
  double zoom = 1.0;       ///< 1: the whole plane; in [1, 8]
};

/// Values that a page holds at most: about 5.6 MB of text.
constexpr std::size_t most_page_values = 4'200'000;

/// A solution as `value_report` shows it, schema `saca.value_page/1` (docs/formats.md): one byte
/// per value. Snapshots, then points of the longest axes, are left out evenly where there are too
/// many.
/// @throws ContractViolation  if the grid has fewer than two axes or there is no such snapshot
[[nodiscard]] std::string value_json(const danger::Solution& solved, const ValueView& view,
                                     std::size_t most_values = most_page_values);

}  // namespace saca::report

#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "saca/thinking/danger/grid.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::reach_study {

/// A disc of 2.1 m about the origin, whatever course and speed are: V = 2.1 m less the distance, at
/// 0.5 s, and 1 m more at 1 s. No case: its text has a name alone.
inline danger::Solution disc_solution() {
  constexpr double pi = std::numbers::pi;
  danger::Solution solved{.grid = {{{.name = "x", .first = -20.0, .last = 10.0, .points = 31},
                                    {.name = "y",
                                     .first = 0.0,
                                     .last = 10.0,
                                     .points = 11,
                                     .edge = danger::Edge::mirrored,
                                     .turned = 2},
                                    {.name = "course",
                                     .first = -pi,
                                     .last = pi,
                                     .points = 4,
                                     .edge = danger::Edge::periodic},
                                    {.name = "speed", .first = 0.0, .last = 18.0, .points = 4}}},
                          .problem = "name = \"disc\"\n",
                          .complete = true,
                          .times = {0.5, 1.0}};
  danger::Snapshots<float> values(2);
  for (std::size_t i = 0; i < danger::num_cells(solved.grid); ++i) {
    const danger::State at = danger::state_at(solved.grid, i);
    const double v = 2.1 - std::hypot(at[0], at[1]);
    values[0].push_back(static_cast<float>(v));
    values[1].push_back(static_cast<float>(v + 1.0));
  }
  solved.values = values;
  return solved;
}

}  // namespace saca::reach_study

#pragma once

#include <memory>
#include <numbers>
#include <optional>

#include "saca/reach/avoidance.h"
#include "saca/reach/danger.h"
#include "saca/reach/own_systems.h"
#include "saca/reach/solve.h"
#include "saca/world/footprint.h"

namespace saca::danger {

/// A solved table of a small car before a square at rest, within 40 m and up to 20 m/s: coarse, for
/// which of two inputs is better rather than for metres.
struct SquareAtRest {
  reach::Avoidance limits{.grip = 0.9, .tightest_curvature = 0.235, .drive_share = 0.48};
  world::Footprint ego{.length = 2.0, .width = 2.0};
  world::Footprint square{.length = 2.0, .width = 2.0};
  reach::DangerModel model{limits, ego, {table()}};

 private:
  [[nodiscard]] reach::DangerTable table() const {
    constexpr double pi = std::numbers::pi;
    reach::AvoidanceCase asked;
    asked.system = limits;
    asked.ego = ego;
    asked.obstacle = square;
    asked.grid.axes = {
        {.name = "x", .first = -40.0, .last = 40.0, .points = 33, .stretch = 6.0},
        {.name = "y",
         .first = 0.0,
         .last = 40.0,
         .points = 17,
         .edge = reach::Edge::mirrored,
         .stretch = 6.0,
         .turned = 2},
        {.name = "course", .first = -pi, .last = pi, .points = 32, .edge = reach::Edge::periodic},
        {.name = "speed", .first = 0.0, .last = 20.0, .points = 9}};
    asked.times = {3.0};
    const reach::Problem problem = reach::avoidance_problem(asked);
    const auto values =
        reach::solve(problem, {.steps = reach::Steps::tvd_rk2, .threads = 2}, std::nullopt, {})
            .value();
    return {square, 0.0, reach::View::obstacle,
            std::make_shared<reach::ValueTable>(problem.grid, reach::snapshot(values, 0),
                                                values.error)};
  }
};

}  // namespace saca::danger

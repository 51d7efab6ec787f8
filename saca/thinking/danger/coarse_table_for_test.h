#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <optional>

#include "saca/base/world/footprint.h"
#include "saca/lab/levelset/own_systems.h"
#include "saca/lab/levelset/solve.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/danger.h"

namespace saca::danger {

/// V_h within 40 m of an obstacle and up to 20 m/s, 3 s ahead, solved in a moment: coarse, right to
/// some tenths of a metre.
inline DangerTable coarse_table(const Avoidance& system, const world::Footprint& ego,
                                const world::Footprint& obstacle) {
  constexpr double pi = std::numbers::pi;
  AvoidanceCase asked;
  asked.system = system;
  asked.ego = ego;
  asked.obstacle = obstacle;
  asked.grid.axes = {
      {.name = "x", .first = -40.0, .last = 40.0, .points = 33, .stretch = 6.0},
      {.name = "y",
       .first = 0.0,
       .last = 40.0,
       .points = 17,
       .edge = Edge::mirrored,
       .stretch = 6.0,
       .turned = 2},
      {.name = "course", .first = -pi, .last = pi, .points = 32, .edge = Edge::periodic},
      {.name = "speed", .first = 0.0, .last = 20.0, .points = 9}};
  asked.times = {3.0};
  const levelset::Problem problem = levelset::avoidance_problem(asked);
  const auto values =
      levelset::solve(problem, {.steps = levelset::Steps::tvd_rk2, .threads = 2}, std::nullopt, {});
  EXPECT_TRUE(values.has_value());
  return {obstacle, system.obstacle_speed, View::obstacle,
          std::make_shared<ValueTable>(problem.grid, snapshot(values.value(), 0),
                                       values.value().error)};
}

}  // namespace saca::danger

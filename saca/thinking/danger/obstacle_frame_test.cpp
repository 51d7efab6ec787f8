#include "saca/thinking/danger/obstacle_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::danger::obstacle_frame_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Ahead from -10 to 30 m, left to 8 m; or x from -30 to 10 m, y to 8 m.
std::string case_text(bool seen_from_ego) {
  const std::string text =
      "schema = \"saca.avoidance/1\"\nname = \"a\"\nsnapshots_s = [1.0]\n"
      "[car]\ngrip = 0.9\ntightest_curvature_1pm = 0.2\ndrive_share = 0.5\n"
      "[ego]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\ncentre_m = 0\n"
      "[obstacle]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\nspeed_mps = 0\n";
  const std::string rest = "points = 24\n[grid.speed]\nlast_mps = 20\npoints = 5\n";
  return seen_from_ego ? "seen_from = \"ego\"\n" + text +
                             "[grid.ahead]\nfirst_m = -10\nlast_m = 30\npoints = 81\n"
                             "[grid.left]\nlast_m = 8\npoints = 17\n[grid.turned]\n" +
                             rest
                       : "seen_from = \"obstacle\"\n" + text +
                             "[grid.x]\nfirst_m = -30\nlast_m = 10\npoints = 81\n"
                             "[grid.y]\nlast_m = 8\npoints = 17\n[grid.course]\n" +
                             rest;
}

/// Values of a function of x, y, course and speed, in the case's own view.
Solution solved_case(bool seen_from_ego, double (*value)(const State&)) {
  Solution solved{
      .grid = {}, .problem = case_text(seen_from_ego), .complete = true, .times = {1.0}};
  solved.grid = parse_avoidance_case(solved.problem, "made here").value().grid;
  const auto of_cell = [&](std::span<const double> s) {
    if (!seen_from_ego) {
      return value({s[0], s[1], s[2], s[3]});
    }
    const double c = std::cos(s[2]);  // the obstacle's x axis in the ego's frame: (c, sin)
    const double sin = std::sin(s[2]);
    return value({-(c * s[0] + sin * s[1]), sin * s[0] - c * s[1], -s[2], s[3]});
  };
  solved.values = Snapshots<float>{sampled<float>(solved.grid, of_cell, 1)};
  return solved;
}

/// A cone that leans: linear along both views' axes but for the distance.
double leaning(const State& s) {
  return 3.0 - std::hypot(s[0], s[1]) + 0.1 * s[3];
}

TEST(ViewOf, IsToldByTheFilesProblem) {
  EXPECT_EQ(view_of(solved_case(true, leaning)), View::ego);
  EXPECT_EQ(view_of(solved_case(false, leaning)), View::obstacle);
}

TEST(ViewOf, IsNoneOfOtherProblemsAndOtherGrids) {
  Solution solved = solved_case(true, leaning);
  solved.grid.axes.pop_back();
  EXPECT_EQ(view_of(solved), std::nullopt);
  solved = solved_case(true, leaning);
  solved.grid.axes[0].name = "x";
  EXPECT_EQ(view_of(solved), std::nullopt);
  solved = solved_case(true, leaning);
  solved.problem = "system = \"air3d\"\n";
  EXPECT_EQ(view_of(solved), std::nullopt);
}

TEST(InObstacleFrame, BothViewsGiveTheSameValue) {
  const Solution by_ego = solved_case(true, leaning);
  const Solution by_obstacle = solved_case(false, leaning);
  const ValueTable ego_table(by_ego.grid, snapshot(by_ego, 0));
  const ValueTable obstacle_table(by_obstacle.grid, snapshot(by_obstacle, 0));
  const ValueAt from_ego = in_obstacle_frame(ego_table, View::ego);
  const ValueAt from_obstacle = in_obstacle_frame(obstacle_table, View::obstacle);
  for (const double course : {0.0, 0.2, -0.2, 0.35}) {
    for (const double x : {-21.0, -12.3, -4.0}) {
      for (const double y : {-0.9, 0.0, 0.4}) {
        const State state{x, y, course, 13.0};
        const LookupResult one = from_ego(state);
        const LookupResult other = from_obstacle(state);
        ASSERT_TRUE(one.inside && other.inside) << x << ' ' << y << ' ' << course;
        EXPECT_NEAR(one.value, leaning(state), 0.03);  // spacing^2 / 8 / distance
        EXPECT_NEAR(other.value, leaning(state), 0.03);
      }
    }
  }
}

TEST(InObstacleFrame, TellsLeftFromRightAndTheDirectionOfTheCourse) {
  // Both grids hold these functions' values at their points; all states are such points.
  const std::array<double (*)(const State&), 3> functions{
      [](const State& s) { return s[0]; },
      [](const State& s) { return s[1] * std::sin(s[2]); },  // unchanged by the mirror
      [](const State& s) { return std::cos(s[2]); }};
  for (const auto& function : functions) {
    const Solution solved = solved_case(true, function);
    const ValueTable table(solved.grid, snapshot(solved, 0));
    for (const State& state : {State{-20.0, 3.0, 0.0, 5.0}, State{3.0, -20.0, 0.5 * pi, 5.0},
                               State{-3.0, 20.0, -0.5 * pi, 10.0}, State{20.0, -4.0, -pi, 10.0}}) {
      const LookupResult found = in_obstacle_frame(table, View::ego)(state);
      EXPECT_TRUE(found.inside);
      EXPECT_NEAR(found.value, function(state), 1e-5);
    }
  }
}

TEST(InObstacleFrame, WhatTheGridDoesNotHoldIsOutside) {
  const Solution solved = solved_case(true, leaning);
  const ValueTable table(solved.grid, snapshot(solved, 0));
  const ValueAt value = in_obstacle_frame(table, View::ego);
  EXPECT_TRUE(value({-29.0, 7.0, 0.0, 5.0}).inside);
  EXPECT_FALSE(value({-31.0, 0.0, 0.0, 5.0}).inside);  // obstacle 31 m ahead
  EXPECT_FALSE(value({-29.0, 8.5, 0.0, 5.0}).inside);
  EXPECT_FALSE(value({-29.0, 7.0, 0.5 * pi, 5.0}).inside);  // 29 m to the left
  EXPECT_TRUE(value({7.0, -29.0, 0.5 * pi, 5.0}).inside);
}

TEST(AxesInObstacleFrame, SpanWhatTheGridHoldsAtTheCourse) {
  const Grid grid = solved_case(true, leaning).grid;
  const auto expect_range = [&](double course, std::size_t axis, double low, double high) {
    const auto axes = axes_in_obstacle_frame(grid, course);
    EXPECT_NEAR(axes[axis].first, low, 1e-9) << course;
    EXPECT_NEAR(axes[axis].last, high, 1e-9) << course;
  };
  expect_range(0.0, 0, -30.0, 10.0);
  expect_range(0.0, 1, -8.0, 8.0);
  expect_range(0.5 * pi, 0, -8.0, 8.0);
  expect_range(0.5 * pi, 1, -30.0, 10.0);
  expect_range(pi, 0, -10.0, 30.0);
  const double half = std::sqrt(0.5);
  expect_range(0.25 * pi, 0, -38.0 * half, 18.0 * half);
  expect_range(-0.25 * pi, 1, -18.0 * half, 38.0 * half);
}

TEST(AxesInObstacleFrame, AreNamedAsAnObstaclesAre) {
  const auto axes = axes_in_obstacle_frame(solved_case(true, leaning).grid, 0.0);
  const Grid wanted = solved_case(false, leaning).grid;
  ASSERT_EQ(axes.size(), 4U);
  for (std::size_t d = 0; d < 4; ++d) {
    EXPECT_EQ(axes[d].name, wanted.axes[d].name);
  }
  EXPECT_EQ(axes[2].edge, Edge::periodic);
  EXPECT_EQ(broken_rule({axes}), std::nullopt);
}

TEST(InObstacleFrame, RefusesWhatHasNoObstacle) {
  const Solution solved = solved_case(true, leaning);
  const ValueTable table(solved.grid, snapshot(solved, 0));
  EXPECT_THROW((void)in_obstacle_frame(table, View::edge), ContractViolation);
  EXPECT_THROW((void)axes_in_obstacle_frame({{solved.grid.axes[0]}}, 0.0), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::obstacle_frame_test

#include "saca/thinking/danger/grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::danger::grid_test {
namespace {

constexpr double pi = std::numbers::pi;
using testing::HasSubstr;

Grid usual() {
  return {
      .axes = {{.name = "x", .first = -8.0, .last = 8.0, .points = 9, .stretch = 2.0},
               {.name = "y",
                .first = 0.0,
                .last = 4.0,
                .points = 5,
                .edge = Edge::mirrored,
                .turned = 2},
               {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = Edge::periodic}}};
}

TEST(Grid, NumbersItsCellsAlongTheFirstAxisFirst) {
  const Grid grid = usual();
  EXPECT_EQ(num_cells(grid), 9U * 5U * 8U);
  EXPECT_THAT(strides(grid), testing::ElementsAre(1, 9, 45));
  const Cell cell = cell_at(grid, 3 + 9 * (2 + 5 * 6));
  EXPECT_EQ(cell[0], 3);
  EXPECT_EQ(cell[1], 2);
  EXPECT_EQ(cell[2], 6);
}

TEST(Axis, BeginsAndEndsWhereItSays) {
  const Grid grid = usual();
  EXPECT_NEAR(coordinate(grid.axes[0], 0), -8.0, 1e-12);
  EXPECT_NEAR(coordinate(grid.axes[0], 4), 0.0, 1e-12);  // stretched about 0
  EXPECT_NEAR(coordinate(grid.axes[0], 8), 8.0, 1e-12);
  EXPECT_DOUBLE_EQ(coordinate(grid.axes[1], 3), 3.0);
  EXPECT_DOUBLE_EQ(coordinate(grid.axes[2], 4), 0.0);
  EXPECT_DOUBLE_EQ(coordinate(grid.axes[2], 7), 0.75 * pi);  // the end is the beginning
}

TEST(Axis, SpacingIsTheSlopeOfTheCoordinate) {
  const Axis axis = usual().axes[0];
  const Axis finer{.name = "x", .first = -8.0, .last = 8.0, .points = 8001, .stretch = 2.0};
  for (int i = 1; i < 8; ++i) {  // point i of 9 is point 1000 i of 8001
    const double slope =
        (coordinate(finer, 1000 * i + 1) - coordinate(finer, 1000 * i - 1)) * 500.0;
    EXPECT_NEAR(spacing(axis, i), slope, 1e-5 * slope);
  }
  EXPECT_DOUBLE_EQ(spacing(usual().axes[2], 3), pi / 4.0);
}

TEST(Axis, PointOfIsTheInverseOfCoordinate) {
  for (const Axis& axis : usual().axes) {
    for (int i = 0; i < axis.points; ++i) {
      EXPECT_NEAR(point_of(axis, coordinate(axis, i)), i, 1e-12) << axis.name;
    }
  }
  const Axis course = usual().axes[2];
  EXPECT_NEAR(point_of(course, pi), 0.0, 1e-12);  // around the circle
  EXPECT_NEAR(point_of(course, 7.0 * pi + 0.1), point_of(course, -pi + 0.1), 1e-9);
  EXPECT_NEAR(point_of(course, -pi - pi / 8.0), 7.5, 1e-12);
  EXPECT_LT(point_of(course, std::nextafter(-pi, -4.0)), 8.0);
  EXPECT_LT(point_of(usual().axes[1], -1.0), 0.0);  // beyond an edge: beyond the points
}

TEST(Sampled, HasEachCellsValueOnAnyNumberOfThreads) {
  const Grid grid = usual();
  const auto of = [](std::span<const double> x) { return x[0] + 10.0 * x[1] + 100.0 * x[2]; };
  const auto values = sampled<double>(grid, of, 3);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const State x = state_at(grid, i);
    EXPECT_DOUBLE_EQ(values[i], x[0] + 10.0 * x[1] + 100.0 * x[2]);
  }
  EXPECT_EQ(values, sampled<double>(grid, of, 1));
}

TEST(Sampled, AsksOnceForWhatIsAlikeAlongTheLastAxis) {
  const Grid grid = usual();
  const auto of = [](std::span<const double> x) { return x[0] + 10.0 * x[1]; };
  std::atomic<int> asked = 0;
  const auto counted = [&](std::span<const double> x) {
    ++asked;
    return of(x);
  };
  EXPECT_EQ(sampled<float>(grid, counted, 2, true), sampled<float>(grid, of, 1));
  EXPECT_EQ(asked, 9 * 5);
  EXPECT_THROW((void)sampled<float>({.axes = {grid.axes[0]}}, of, 1, true), ContractViolation);
}

std::string refused(const std::function<void(Grid&)>& change) {
  Grid grid = usual();
  change(grid);
  return broken_rule(grid).value_or("nothing");
}

TEST(BrokenRule, NamesTheAxisWhatIsWantedAndWhatCame) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(broken_rule(usual()), std::nullopt);
  EXPECT_EQ(refused([](Grid& g) { g.axes[0].points = 1; }),
            "axis 1 (x): wanted at least 4 points, got 1");
  EXPECT_THAT(refused([](Grid& g) { g.axes[0].last = -8.0; }),
              HasSubstr("first < last, got -8 and -8"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[2].last = -9.0; }),
              HasSubstr("axis 3 (course): wanted first < last"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[0].first = nan; }), HasSubstr("got nan"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[0].stretch = -1.0; }),
              HasSubstr("stretch >= 0, got -1"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[0].stretch = nan; }), HasSubstr("stretch"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[2].stretch = 1.0; }),
              HasSubstr("periodic axis is even"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[1].first = -1.0; }), HasSubstr("begins at 0, got -1"));
  EXPECT_THAT(refused([](Grid& g) { g.axes[1].turned = 0; }),
              HasSubstr("periodic axis, got axis 1"));
  EXPECT_THAT(refused([](Grid& g) {
                g.axes[2].first += 0.1;
                g.axes[2].last += 0.1;
              }),
              HasSubstr("both sides of 0"));
  EXPECT_THAT(refused([](Grid& g) { g.axes.clear(); }), HasSubstr("1 to 4 axes, got 0"));
  EXPECT_THAT(refused([](Grid& g) { g.axes.resize(5, g.axes[0]); }), HasSubstr("got 5"));
  Grid grid = usual();
  grid.axes[0].points = 1;
  EXPECT_THROW((void)sampled<float>(
                   grid, [](auto) { return 0.0; }, 1),
               ContractViolation);
}

TEST(Described, GivesEachCoordinateItsName) {
  EXPECT_EQ(described(usual(), {1.5, 0.0, 0.25, 9.0}), "x = 1.5, y = 0, course = 0.25");
}

}  // namespace
}  // namespace saca::danger::grid_test

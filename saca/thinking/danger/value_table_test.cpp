#include "saca/thinking/danger/value_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::danger::value_table_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// As the avoidance problem has it: stretched, mirrored with the course turned, periodic, even.
Grid avoidance_grid() {
  return {{{.name = "x", .first = -40.0, .last = 25.0, .points = 23, .stretch = 6.0},
           {.name = "y",
            .first = 0.0,
            .last = 20.0,
            .points = 11,
            .edge = Edge::mirrored,
            .stretch = 5.0,
            .turned = 2},
           {.name = "course", .first = -pi, .last = pi, .points = 12, .edge = Edge::periodic},
           {.name = "speed", .first = 0.0, .last = 30.0, .points = 7}}};
}

Grid first_axes(std::size_t dimensions) {
  Grid grid = avoidance_grid();
  grid.axes.resize(dimensions);
  if (dimensions == 2) {
    grid.axes[1].turned = std::nullopt;
  }
  return grid;
}

std::vector<float> noise(std::size_t size, unsigned seed) {
  std::mt19937 chance(seed);
  std::uniform_real_distribution<float> any(0.0F, 3.0F);
  std::vector<float> values(size);
  std::generate(values.begin(), values.end(), [&] { return any(chance); });
  return values;
}

State drawn(std::mt19937& chance, double room) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  return {-40.0 * room + 65.0 * room * any(chance), room * (40.0 * any(chance) - 20.0),
          20.0 * any(chance) - 10.0, room * 30.0 * any(chance)};
}

// --- slow and obvious ---------------------------------------------------------------------------

struct Bracket {
  int low, high;
  double share;
};

Bracket bracket(const Axis& axis, double x) {
  const int last = axis.points - 1;
  if (axis.edge == Edge::periodic) {
    const double period = axis.last - axis.first;
    while (x < axis.first) {
      x += period;
    }
    while (x >= axis.last) {
      x -= period;
    }
    if (x >= coordinate(axis, last)) {
      return {last, 0, (x - coordinate(axis, last)) / (axis.last - coordinate(axis, last))};
    }
  }
  x = std::max(axis.first, std::min(axis.last, x));
  int low = last - 1;
  while (low > 0 && coordinate(axis, low) > x) {
    --low;
  }
  const double from = coordinate(axis, low);
  return {low, low + 1, (x - from) / (coordinate(axis, low + 1) - from)};
}

double slow_value(const Grid& grid, const std::vector<float>& values, State state, Cell cell,
                  std::size_t axis) {
  if (axis == grid.axes.size()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (cell_at(grid, i) == cell) {
        return static_cast<double>(values[i]);
      }
    }
    return nan;
  }
  const Bracket between = bracket(grid.axes[axis], state[axis]);
  cell[axis] = between.low;
  const double low = slow_value(grid, values, state, cell, axis + 1);
  cell[axis] = between.high;
  return (1.0 - between.share) * low +
         between.share * slow_value(grid, values, state, cell, axis + 1);
}

double slow_value(const Grid& grid, const std::vector<float>& values, State state) {
  if (grid.axes.size() > 1 && state[1] < 0.0) {
    state[1] = -state[1];
    state[2] = grid.axes.size() > 2 ? -state[2] : state[2];
  }
  return slow_value(grid, values, state, {}, 0);
}

// --- tests --------------------------------------------------------------------------------------

TEST(ValueTable, AgreesWithASlowInterpolationInEveryDimension) {
  for (std::size_t dimensions = 1; dimensions <= max_dimensions; ++dimensions) {
    const Grid grid = first_axes(dimensions);
    const std::vector<float> values = noise(num_cells(grid), 5);
    const ValueTable table(grid, values);
    std::mt19937 chance(7);
    for (int i = 0; i < 30; ++i) {
      const State state = drawn(chance, 1.2);
      EXPECT_NEAR(table.at(state).value, slow_value(grid, values, state), 1e-12)
          << dimensions << " axes: " << described(grid, state);
    }
  }
}

TEST(ValueTable, IsExactOnLinearFunctionsAndAtThePoints) {
  Grid grid = avoidance_grid();
  grid.axes[1] = {.name = "y", .first = -20.0, .last = 20.0, .points = 14, .stretch = 5.0};
  grid.axes[2] = {.name = "course", .first = -3.0, .last = 3.0, .points = 9};
  const auto linear = [](std::span<const double> s) {
    return 0.25 * s[0] - 0.5 * s[1] + 2.0 * s[2] - 0.125 * s[3] + 1.0;
  };
  const std::vector<float> values = sampled<float>(grid, linear, 1);
  const ValueTable table(grid, values);
  std::mt19937 chance(3);
  for (int i = 0; i < 2000; ++i) {
    State state = drawn(chance, 1.0);
    state[2] *= 0.3;
    const double rounding = 2e-6;  // of values up to 25, kept as float
    ASSERT_NEAR(table.at(state).value, linear(state), rounding) << described(grid, state);
    const State slope = table.gradient(state);
    const State wanted{0.25, -0.5, 2.0, -0.125};
    for (std::size_t d = 0; d < 4; ++d) {
      ASSERT_NEAR(slope[d], wanted[d], 2e-5) << described(grid, state);
    }
  }
  for (std::size_t i = 0; i < values.size(); i += 37) {
    EXPECT_NEAR(table.at(state_at(grid, i)).value, static_cast<double>(values[i]), 1e-5);
  }
}

TEST(ValueTable, GoesOnAcrossThePeriodicSeam) {
  const Grid grid = avoidance_grid();
  const ValueTable table(grid, noise(num_cells(grid), 11));
  std::mt19937 chance(13);
  for (int i = 0; i < 200; ++i) {
    State state = drawn(chance, 1.0);
    const double there = table.at(state).value;
    state[2] += 2.0 * pi;
    EXPECT_NEAR(table.at(state).value, there, 1e-12);
    state[2] = pi - 1e-9;
    const double before = table.at(state).value;
    state[2] = -pi + 1e-9;
    EXPECT_NEAR(table.at(state).value, before, 1e-7);
  }
}

TEST(ValueTable, IsItsOwnMirrorImage) {
  const Grid grid = avoidance_grid();
  const ValueTable table(grid, noise(num_cells(grid), 17));
  std::mt19937 chance(19);
  for (int i = 0; i < 200; ++i) {
    const State state = drawn(chance, 0.9);
    const State image{state[0], -state[1], -state[2], state[3]};
    EXPECT_NEAR(table.at(state).value, table.at(image).value, 1e-12);
    const State slope = table.gradient(state);
    const State other = table.gradient(image);
    EXPECT_NEAR(slope[0], other[0], 1e-9);
    EXPECT_NEAR(slope[1], -other[1], 1e-9);
    EXPECT_NEAR(slope[2], -other[2], 1e-9);
    EXPECT_NEAR(slope[3], other[3], 1e-9);
  }
}

TEST(ValueTable, GradientOfASmoothFunctionIsItsSlope) {
  Grid grid{{{.name = "x", .first = -2.0, .last = 2.0, .points = 201},
             {.name = "course", .first = -pi, .last = pi, .points = 240, .edge = Edge::periodic}}};
  const ValueTable table(
      grid, sampled<float>(
                grid, [](std::span<const double> s) { return s[0] * s[0] + std::sin(s[1]); }, 1));
  std::mt19937 chance(23);
  std::uniform_real_distribution<double> any(-1.9, 1.9);
  for (int i = 0; i < 500; ++i) {
    const State state{any(chance), 3.0 * any(chance)};
    const State slope = table.gradient(state);
    EXPECT_NEAR(slope[0], 2.0 * state[0], 0.02);       // one spacing's change of the slope
    EXPECT_NEAR(slope[1], std::cos(state[1]), 0.002);  // spacing^2, and rounding / spacing
  }
}

TEST(ValueTable, BeyondAnOpenEndIsTheNearestStateAndSaysSo) {
  const Grid grid = avoidance_grid();
  const ValueTable table(grid, noise(num_cells(grid), 29));
  const LookupResult edge = table.at({25.0, 3.0, 1.0, 30.0});
  const LookupResult beyond = table.at({31.0, 3.0, 1.0, 44.0});
  EXPECT_TRUE(edge.inside);
  EXPECT_FALSE(beyond.inside);
  EXPECT_EQ(beyond.value, edge.value);
  EXPECT_FALSE(table.at({0.0, 20.1, 0.0, 5.0}).inside);
  EXPECT_FALSE(table.at({0.0, -20.1, 0.0, 5.0}).inside);
  EXPECT_TRUE(table.at({0.0, -20.0, 100.0, 5.0}).inside);
  EXPECT_FALSE(table.at({-40.1, 0.0, 0.0, 5.0}).inside);
  EXPECT_FALSE(table.at({1e300, 0.0, 0.0, 5.0}).inside);
}

TEST(ValueTable, AStateThatIsNoNumberIsNeverSafe) {
  const Grid grid = avoidance_grid();
  const ValueTable table(grid, std::vector<float>(num_cells(grid), -5.0F));
  for (const double bad :
       {nan, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    for (std::size_t d = 0; d < 4; ++d) {
      State state{1.0, 2.0, 0.5, 9.0};
      state[d] = bad;
      EXPECT_EQ(table.at(state).value, std::numeric_limits<double>::infinity());
      EXPECT_FALSE(table.at(state).inside);
      EXPECT_TRUE(std::isnan(table.gradient(state)[0]));
    }
  }
}

TEST(ValueTable, ErrorIsTheGreatestOfTheCornersAndZeroWhereUnknown) {
  const Grid grid = first_axes(1);
  const std::vector<float> values(num_cells(grid), 1.0F);
  std::vector<float> errors(num_cells(grid), 0.125F);
  errors[4] = 0.75F;
  const ValueTable table(grid, values, errors);
  const Axis& x = grid.axes[0];
  const auto between = [&](int low) {
    return State{0.5 * (coordinate(x, low) + coordinate(x, low + 1))};
  };
  EXPECT_EQ(table.at(between(2)).error, 0.125);
  EXPECT_EQ(table.at(between(3)).error, 0.75);
  EXPECT_EQ(table.at(between(4)).error, 0.75);
  EXPECT_EQ(table.at(between(5)).error, 0.125);
  EXPECT_EQ(ValueTable(grid, values).at(between(3)).error, 0.0);
}

TEST(ValueTable, RefusesWhatDoesNotFit) {
  const Grid grid = first_axes(3);
  std::vector<float> values(num_cells(grid), 1.0F);
  std::vector<float> errors(num_cells(grid), 0.0F);
  EXPECT_THROW(ValueTable(Grid{}, values), ContractViolation);
  EXPECT_THROW(ValueTable(grid, std::span(values).first(7)), ContractViolation);
  EXPECT_THROW(ValueTable(grid, values, std::span(errors).first(7)), ContractViolation);
  errors[3] = -0.1F;
  EXPECT_THROW(ValueTable(grid, values, errors), ContractViolation);
  values[8] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ValueTable(grid, values), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::value_table_test

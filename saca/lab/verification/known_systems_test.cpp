#include "saca/lab/verification/known_systems.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/levelset/flow_of.h"
#include "saca/thinking/danger/march_for_test.h"

namespace saca::verification::known_systems_test {
namespace {

constexpr std::array all_differences{levelset::Differences::upwind1, levelset::Differences::eno2,
                                     levelset::Differences::eno3, levelset::Differences::weno5};

/// Axes of different lengths and numbers of points.
danger::Grid room(std::size_t dimensions) {
  danger::Grid grid;
  for (std::size_t d = 0; d < dimensions; ++d) {
    const double half = 1.0 + static_cast<double>(d);
    grid.axes.push_back({.name = std::string(1, static_cast<char>('x' + d)),
                         .first = -half,
                         .last = half,
                         .points = 23 - static_cast<int>(d)});
  }
  return grid;
}

double linear(std::span<const double> x) {
  constexpr std::array slopes{2.0, 0.5, -1.0};
  double sum = 0.3;
  for (std::size_t d = 0; d < x.size(); ++d) {
    sum += slopes.at(d) * x[d];
  }
  return sum;
}

constexpr double horizon = 0.01;  // [s], less than a step

/// Whether a step of three stages, each of which looks at three points to either side, sees no open
/// end from there.
bool is_inside(const danger::Grid& grid, const danger::Cell& cell) {
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    if (cell[d] < 9 || grid.axes[d].points - 1 - cell[d] < 9) {
      return false;
    }
  }
  return true;
}

/// From a linear h every difference is exact, and so are steps of third order where the value is of
/// second degree in time: what is left is rounding.
/// @param flow   of a grid and differences
/// @param added  to h at a state, by the horizon
template <class Real>
void expect_from_linear(std::size_t dimensions, const auto& flow, const auto& added) {
  const danger::Grid grid = room(dimensions);
  const auto h = danger::sampled<Real>(grid, linear, 1);
  const double rounding = sizeof(Real) == sizeof(double) ? 1e-13 : 1e-6;
  for (const levelset::Differences differences : all_differences) {
    const auto values = danger::marched<Real>(grid, flow(grid, differences), h, horizon,
                                              {.tube = levelset::Tube::set});
    int compared = 0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      if (!is_inside(grid, danger::cell_at(grid, i))) {
        continue;
      }
      ++compared;
      const danger::State x = danger::state_at(grid, i);
      ASSERT_NEAR(values[i], linear({x.data(), dimensions}) + added(x), rounding)
          << static_cast<int>(differences) << ", " << described(grid, x);
    }
    EXPECT_GE(compared, 5);
  }
}

double of_motion(const danger::State& /*x*/) {
  return horizon * (2.0 * 1.0 + 0.5 * -0.5);
}
// Slopes (2, 0.5) and tau later (2, 0.5 + 2 tau): brakes take 1 x the latter from each second.
double of_braking(const danger::State& x) {
  return 2.0 * x[1] * horizon - (0.5 * horizon + horizon * horizon);
}

TEST(KnownFlow, CarriesALinearValueAsTheClosedFormDoes) {
  expect_from_linear<double>(
      2,
      [](auto& grid, auto d) {
        return known_flow<double>(grid, ConstantMotion{1.0, -0.5}, d);
      },
      of_motion);
  const auto braking = [&]<class Real>() {
    expect_from_linear<Real>(
        2, [](auto& grid, auto d) { return known_flow<Real>(grid, DoubleIntegrator{1.0}, d); },
        of_braking);
  };
  braking.operator()<double>();
  braking.operator()<float>();
}

TEST(KnownFlow, GrowsALinearValueByItsSteepness) {
  const auto check = [&]<class Real, std::size_t D>(double steepness) {
    for (const double speed : {1.5, -1.5}) {
      expect_from_linear<Real>(
          D, [&](auto& grid, auto d) { return known_flow<Real>(grid, AnyDirection<D>{speed}, d); },
          [&](const danger::State&) { return horizon * speed * steepness; });
    }
  };
  check.operator()<double, 1>(2.0);
  check.operator()<double, 2>(std::hypot(2.0, 0.5));
  check.operator()<double, 3>(std::hypot(2.0, 0.5, 1.0));
  check.operator()<float, 3>(std::hypot(2.0, 0.5, 1.0));
}

// The same loops, compiled with this test: what a sanitiser looks into.
TEST(FlowOf, HasTheSameClosedForms) {
  struct Motion : ConstantMotion {};
  struct Braking : DoubleIntegrator {};
  expect_from_linear<double>(
      2,
      [](auto& grid, auto d) {
        return levelset::flow_of<double>(grid, Motion{{1.0, -0.5}}, d);
      },
      of_motion);
  expect_from_linear<float>(
      2, [](auto& grid, auto d) { return levelset::flow_of<float>(grid, Braking{{1.0}}, d); },
      of_braking);
}

}  // namespace
}  // namespace saca::verification::known_systems_test

#include "saca/lab/levelset/solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "saca/lab/levelset/flow_of.h"
#include "saca/lab/verification/known_systems.h"
#include "saca/thinking/danger/march_for_test.h"

namespace saca::levelset::solver_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Even axes from -half to half.
danger::Grid square(std::size_t dimensions, double half, int points) {
  danger::Grid grid;
  for (std::size_t d = 0; d < dimensions; ++d) {
    grid.axes.push_back({.name = std::string(1, static_cast<char>('x' + d)),
                         .first = -half,
                         .last = half,
                         .points = points});
  }
  return grid;
}

double radius(std::span<const double> x) {
  double sum = 0.0;
  for (const double c : x) {
    sum += c * c;
  }
  return std::sqrt(sum);
}

// Largest error of a smooth periodic value carried along: V(x, tau) = h(x + v tau).
double motion_error(Differences differences, Steps steps, int points, double cfl) {
  danger::Grid grid = square(2, pi, points);
  grid.axes[0].edge = grid.axes[1].edge = danger::Edge::periodic;
  const verification::ConstantMotion system{1.0, -0.5};
  const auto h_at = [](double x, double y) { return std::sin(x) * std::cos(y); };
  const auto h = danger::sampled<double>(
      grid, [&](auto x) { return h_at(x[0], x[1]); }, 1);
  const auto values =
      danger::marched<double>(grid, verification::known_flow<double>(grid, system, differences), h,
                              1.0, {.tube = Tube::set, .steps = steps, .cfl = cfl});
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const danger::State x = danger::state_at(grid, i);
    worst = std::max(worst, std::abs(values[i] - h_at(x[0] + 1.0, x[1] - 0.5)));
  }
  return worst;
}

// Steps so short that only the differences count.
TEST(Solver, ConvergesInTheOrderOfItsDifferences) {
  const auto order = [](Differences differences, int coarse) {
    return std::log2(motion_error(differences, Steps::tvd_rk3, coarse, 0.1) /
                     motion_error(differences, Steps::tvd_rk3, 2 * coarse, 0.1));
  };
  EXPECT_NEAR(order(Differences::upwind1, 40), 1.0, 0.15);
  EXPECT_GT(order(Differences::eno2, 40), 1.5);  // its order falls at extrema, in the largest error
  EXPECT_GT(order(Differences::eno3, 40), 2.5);
  EXPECT_GT(order(Differences::weno5, 20), 4.0);
}

TEST(Solver, ConvergesInTheOrderOfItsSteps) {
  const auto order = [](Steps steps) {  // differences far better than the steps
    const double coarse = motion_error(Differences::weno5, steps, 120, 1.0);
    return std::log2(coarse / motion_error(Differences::weno5, steps, 120, 0.5));
  };
  EXPECT_NEAR(order(Steps::euler), 1.0, 0.2);
  EXPECT_NEAR(order(Steps::tvd_rk2), 2.0, 0.2);
  EXPECT_NEAR(order(Steps::tvd_rk3), 3.0, 0.3);
}

class Disc : public testing::TestWithParam<std::size_t> {};

// h = radius - distance. Whoever seeks it at speed 1 is in it after tau from radius + tau: V = h +
// tau. Whoever leaves it: V = h - tau, but at the centre, from which all ways are as long.
TEST_P(Disc, GrowsAndShrinksAtItsSpeed) {
  const std::size_t D = GetParam();
  const danger::Grid grid = square(D, 2.0, D == 3 ? 41 : 81);
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return 1.0 - radius(x); }, 1);
  const auto check = [&](double speed) {
    const Flow<double> flow =
        D == 1   ? verification::known_flow<double>(grid, verification::AnyDirection<1>{speed})
        : D == 2 ? verification::known_flow<double>(grid, verification::AnyDirection<2>{speed})
                 : verification::known_flow<double>(grid, verification::AnyDirection<3>{speed});
    const auto values = danger::marched<double>(grid, flow, h, 0.5, {.tube = Tube::set});
    double worst = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const danger::State x = danger::state_at(grid, i);
      const double r = radius({x.data(), D});
      if (r > 0.8 && r < 1.7) {
        worst = std::max(worst, std::abs(values[i] - (1.0 - r + 0.5 * speed)));
      }
    }
    return worst;
  };
  const double spacing = grid.axes[0].last * 2.0 / (grid.axes[0].points - 1);
  EXPECT_LT(check(1.0), 0.02 * spacing);
  EXPECT_LT(check(-1.0), 0.02 * spacing);
}
INSTANTIATE_TEST_SUITE_P(Dimensions, Disc, testing::Values(1U, 2U, 3U));

// Braking before a wall at 0: from v at x < 0 the car comes to x + v^2 / 2a; it hits when that is
// >= 0. The running maximum of h = x is that (v > 0), or x itself (v <= 0).
double braking_error(int points) {
  danger::Grid grid;
  grid.axes = {{.name = "x", .first = -6.0, .last = 2.0, .points = points},
               {.name = "v", .first = -2.0, .last = 3.0, .points = points}};
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return x[0]; }, 1);
  const auto values = danger::marched<double>(
      grid, verification::known_flow<double>(grid, verification::DoubleIntegrator{1.0}), h, 4.0,
      {});
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const danger::State x = danger::state_at(grid, i);
    const double v = std::max(0.0, x[1]);
    const double expected = x[0] + 0.5 * v * v;
    sum += expected < 1.5 ? std::abs(values[i] - expected) : 0.0;  // beyond: out of the grid
  }
  return sum / static_cast<double>(values.size());
}

TEST(Solver, FindsTheStatesFromWhichBrakingIsTooLate) {
  const double coarse = braking_error(41);
  const double fine = braking_error(81);
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(coarse / fine, 1.7);  // first order at least: the value has a kink at v = 0
}

TEST(Solver, AHigherHorizonAndWeakerBrakesAreNeverSafer) {
  const danger::Grid grid = square(2, 3.0, 41);
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return 1.0 - radius(x); }, 1);
  const auto value = [&](double brakes, double horizon) {
    return danger::marched<double>(
        grid,
        verification::known_flow<double>(grid, verification::DoubleIntegrator{brakes},
                                         Differences::upwind1),
        h, horizon, {.steps = Steps::euler});
  };
  const auto strong = value(1.0, 1.0);
  const auto weak = value(0.7, 1.0);
  const auto later = value(1.0, 2.0);
  for (std::size_t i = 0; i < h.size(); ++i) {
    EXPECT_GE(strong[i], h[i]);
    EXPECT_GE(weak[i], strong[i] - 2e-2);   // their steps differ in length
    EXPECT_GE(later[i], strong[i] - 1e-3);  // what goes on beyond an open edge is not monotone
  }
}

// What a disc's tube covers once stays covered, though what it has covered moves on.
TEST(Solver, ATubeKeepsWhatWasUnsafeOnce) {
  danger::Grid grid = square(2, 3.0, 61);
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return 0.5 - radius(x); }, 1);
  const verification::ConstantMotion system{1.0, 0.0};
  const auto at = [&](Tube tube, double x) {
    const auto values = danger::marched<double>(
        grid, verification::known_flow<double>(grid, system), h, 1.5, {.tube = tube});
    const auto i = static_cast<std::size_t>(std::lround((x + 3.0) / 0.1));
    return values[30 * 61 + i];
  };
  EXPECT_NEAR(at(Tube::set, -1.5), 0.5, 0.12);  // the disc's tip, 1.5 s before; rounded by a cell
  EXPECT_NEAR(at(Tube::set, 0.0), -1.0, 0.02);
  EXPECT_NEAR(at(Tube::tube, 0.0), 0.5, 0.03);
  EXPECT_NEAR(at(Tube::tube, -0.7), 0.5, 0.03);
  EXPECT_NEAR(at(Tube::highest, -0.7), 0.5, 0.03);
  EXPECT_NEAR(at(Tube::highest, 1.0), -0.5, 0.02);
}

TEST(Solver, FloatsAreAsGoodAsTheGrid) {
  const danger::Grid grid = square(2, 2.0, 61);
  const auto of = [](auto x) { return 1.0 - radius(x); };
  const auto doubles = danger::marched<double>(
      grid, verification::known_flow<double>(grid, verification::DoubleIntegrator{1.0}),
      danger::sampled<double>(grid, of, 1), 1.0, {});
  const auto floats = danger::marched<float>(
      grid, verification::known_flow<float>(grid, verification::DoubleIntegrator{1.0}),
      danger::sampled<float>(grid, of, 1), 1.0, {});
  for (std::size_t i = 0; i < doubles.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(floats[i]), doubles[i], 1e-4);  // differences of 1e-7 over 0.07
  }
}

TEST(Solver, ThreadsChangeNoBit) {
  const danger::Grid grid = square(3, 2.0, 23);
  const auto h = danger::sampled<float>(
      grid, [](auto x) { return 1.0 - radius(x); }, 1);
  const Flow<float> flow =
      verification::known_flow<float>(grid, verification::AnyDirection<3>{1.0});
  EXPECT_EQ(danger::marched<float>(grid, flow, h, 0.4, {.threads = 1}),
            danger::marched<float>(grid, flow, h, 0.4, {.threads = 3}));
}

/// x' even and y' odd in the heading, of which each is periodic; heading' within 1, avoiding. Axes:
/// heading first or last, and then `mirrored` tells which of the others is y.
template <bool heading_first>
struct Turning {
  static constexpr std::size_t dimensions = 3;
  static constexpr std::size_t h = heading_first ? 0 : 2;
  static constexpr std::size_t x = heading_first ? 1 : 0;
  std::size_t mirrored = x + 1;
  struct Row {
    double heading;
    std::size_t mirrored;
    template <class N>
    N hamiltonian(const N& first, const std::array<N, 3>& p) const {
      const auto [even, odd] = rates(heading_first ? first : N(heading));
      const std::size_t other = 2 * x + 1 - mirrored;
      return even * p[other] + odd * p[mirrored] - abs(p[h]);
    }
    template <class N>
    std::array<N, 3> speeds(const N& /*first*/) const {
      std::array<N, 3> all;
      all.fill(N(1.0));
      return all;
    }
    /// Of a heading in [-pi, 2 pi): parabolas in place of cosine and sine.
    template <class N>
    static std::array<N, 2> rates(const N& any) {
      const N heading = where_less(N(pi), any, any - N(2.0 * pi), any);
      const N size = abs(heading);
      return {N(1.0) - N(2.0 / pi) * size, heading * (N(pi) - size) * N(4.0 / (pi * pi))};
    }
  };
  [[nodiscard]] Row row(const std::array<double, 3>& at) const { return {at[2], mirrored}; }
};

/// Half a world, mirrored along one axis with the heading turned, beside the whole.
template <bool heading_first>
void expect_half_is_whole(std::size_t mirrored, double first_heading) {
  using System = Turning<heading_first>;
  danger::Grid whole = square(3, 2.0, 13);
  whole.axes[System::h] = {.name = "heading",
                           .first = first_heading,
                           .last = first_heading + 2.0 * pi,
                           .points = 12,
                           .edge = danger::Edge::periodic};
  danger::Grid half = whole;
  half.axes[mirrored] = {.name = "y",
                         .first = 0.0,
                         .last = 2.0,
                         .points = 7,
                         .edge = danger::Edge::mirrored,
                         .turned = System::h};
  ASSERT_EQ(danger::broken_rule(half), std::nullopt);
  const auto of = [](std::span<const double> at) {  // off the middle of x, alike in y
    return 1.0 - std::hypot(at[System::x] - 0.3, at[System::x + 1]);
  };
  const auto of_mirrored_x = [](std::span<const double> at) {
    return 1.0 - std::hypot(at[System::x], at[System::x + 1] - 0.3);
  };
  const auto solved_on = [&](const danger::Grid& grid) {
    const auto h = mirrored == System::x ? danger::sampled<double>(grid, of_mirrored_x, 1)
                                         : danger::sampled<double>(grid, of, 1);
    return danger::marched<double>(grid, flow_of<double>(grid, System{mirrored}), h, 0.6, {});
  };
  const auto of_whole = solved_on(whole);
  const auto of_half = solved_on(half);
  const auto stride = danger::strides(whole);
  double moved = 0.0;
  for (std::size_t i = 0; i < of_half.size(); ++i) {
    danger::Cell c = danger::cell_at(half, i);
    c[mirrored] += 6;
    std::size_t j = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      j += static_cast<std::size_t>(c[d]) * stride[d];
    }
    ASSERT_NEAR(of_half[i], of_whole[j], 1e-9) << described(half, danger::state_at(half, i));
    const danger::State at = danger::state_at(half, i);
    moved = std::max(moved, of_half[i] - (mirrored == System::x ? of_mirrored_x(at) : of(at)));
  }
  EXPECT_GT(moved, 0.1);  // there was something to get wrong
}

TEST(Solver, AMirroredHalfIsTheWhole) {
  const double spacing = pi / 6.0;
  for (const double first : {-pi, -0.5 * pi, -pi + 0.5 * spacing, 0.0, -0.5 * spacing, spacing}) {
    SCOPED_TRACE(first);
    expect_half_is_whole<false>(0, first);
    expect_half_is_whole<false>(1, first);
    expect_half_is_whole<true>(1, first);
    expect_half_is_whole<true>(2, first);
  }
}

// An axis that is finest near 0 gives the same answer as an even one, where both are fine.
TEST(Solver, AStretchedAxisIsAnEvenOneInOtherUnits) {
  danger::Grid grid = square(2, 8.0, 81);
  grid.axes[0].stretch = grid.axes[1].stretch = 2.0;
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return 1.0 - radius(x); }, 1);
  const auto values = danger::marched<double>(
      grid, verification::known_flow<double>(grid, verification::AnyDirection<2>{1.0}), h, 2.0,
      {.tube = Tube::set});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const danger::State x = danger::state_at(grid, i);
    const double r = radius({x.data(), 2});
    if (r > 2.5 && r < 5.0) {  // nearer, the middle is reached: V = 1
      EXPECT_NEAR(values[i], 3.0 - r, 0.01) << x[0] << ' ' << x[1];
    }
  }
}

/// x' = 1.
struct Drift {
  static constexpr std::size_t dimensions = 1;
  struct Row {
    template <class N>
    N hamiltonian(const N& /*x*/, const std::array<N, 1>& p) const {
      return p[0];
    }
    template <class N>
    std::array<N, 1> speeds(const N& /*x*/) const {
      return {N(1.0)};
    }
  };
  [[nodiscard]] Row row(const std::array<double, 1>& /*x*/) const { return {}; }
};

// Nothing unsafe comes in over an open edge, nor anything safe.
TEST(Solver, AnOpenEdgeKeepsTheSign) {
  const danger::Grid grid = square(1, 1.0, 21);
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return x[0] - 2.0; }, 1);  // unsafe beyond 2
  for (const double v :
       danger::marched<double>(grid, flow_of<double>(grid, Drift{}), h, 5.0, {.tube = Tube::set})) {
    EXPECT_LT(v, 0.0);
  }
}

/// Its Hamiltonian is no finite number where x + y = 0: numerator / 0.
struct Broken {
  static constexpr std::size_t dimensions = 2;
  double numerator = 0.0;
  struct Row {
    double y, numerator;
    template <class N>
    N hamiltonian(const N& x, const std::array<N, 2>& p) const {
      return p[0] + N(numerator) / abs(x + y);
    }
    template <class N>
    std::array<N, 2> speeds(const N& /*x*/) const {
      return {N(1.0), N(0.0)};
    }
  };
  [[nodiscard]] Row row(const std::array<double, 2>& x) const { return {x[1], numerator}; }
};

template <class Real>
void expect_cell_named(Tube tube, double numerator) {
  const danger::Grid grid = square(2, 1.0, 5);
  const auto h = danger::sampled<Real>(
      grid, [](auto x) { return radius(x); }, 1);
  const auto flow = flow_of<Real>(grid, Broken{numerator}, Differences::upwind1);
  Solver<Real> solver(grid, flow, h, {.tube = tube, .threads = 2});
  const auto step = solver.step(1.0);
  ASSERT_FALSE(step.has_value());
  EXPECT_THAT(step.error().message, testing::HasSubstr("cell 4 (x = 1, y = -1)"));
  EXPECT_EQ(solver.time(), 0.0);
  EXPECT_TRUE(std::equal(h.begin(), h.end(), solver.values().begin()));
}

TEST(Solver, NamesTheCellWhoseHamiltonianIsNoNumber) {
  for (const Tube tube : {Tube::set, Tube::tube, Tube::highest}) {
    for (const double numerator : {0.0, -1.0, 1.0}) {  // no number, -infinity, infinity
      SCOPED_TRACE(testing::Message() << "tube " << static_cast<int>(tube) << ", " << numerator);
      expect_cell_named<float>(tube, numerator);
      expect_cell_named<double>(tube, numerator);
    }
  }
}

/// Its speed is no number where x = -1.
struct SpeedLost {
  static constexpr std::size_t dimensions = 2;
  struct Row {
    template <class N>
    N hamiltonian(const N& /*x*/, const std::array<N, 2>& p) const {
      return p[0];
    }
    template <class N>
    std::array<N, 2> speeds(const N& x) const {
      return {N(2.0) + N(0.0) / abs(x + N(1.0)), N(0.0)};
    }
  };
  [[nodiscard]] Row row(const std::array<double, 2>& /*x*/) const { return {}; }
};

TEST(Solver, RefusesSpeedsThatAreNoNumber) {
  const danger::Grid grid = square(2, 1.0, 9);  // cells of speed 2 follow the one that has none
  const Flow<double> flow = flow_of<double>(grid, SpeedLost{}, Differences::upwind1);
  EXPECT_TRUE(std::isnan(flow.crossings_per_second));
  EXPECT_THROW(Solver<double>(grid, flow, std::vector<double>(81), {}), ContractViolation);
}

TEST(Solver, HandsOnWhatASystemThrows) {
  const danger::Grid grid = square(2, 1.0, 11);
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return radius(x); }, 1);
  Flow<double> flow = verification::known_flow<double>(grid, verification::DoubleIntegrator{1.0});
  flow.sweep = [sound = flow.sweep](const Stage<double>& stage) {
    if (stage.end_row == 11) {
      throw std::domain_error("no such speed");
    }
    return sound(stage);
  };
  for (const int threads : {1, 3}) {
    Solver<double> solver(grid, flow, h, {.threads = threads});
    EXPECT_THROW((void)solver.step(1.0), std::domain_error);
    EXPECT_EQ(solver.time(), 0.0);
    EXPECT_TRUE(std::equal(h.begin(), h.end(), solver.values().begin()));
  }
}

TEST(Solver, GoesOnFromWhereAnotherStopped) {
  const danger::Grid grid = square(2, 2.0, 31);
  const auto h = danger::sampled<float>(
      grid, [](auto x) { return 1.0 - radius(x); }, 1);
  const Flow<float> flow =
      verification::known_flow<float>(grid, verification::DoubleIntegrator{1.0});
  Solver<float> whole(grid, flow, h, {});
  Solver<float> first(grid, flow, h, {});
  danger::march(whole, 0.5);
  danger::march(whole, 1.0);
  danger::march(first, 0.5);
  Solver<float> second(grid, flow, h, {});
  second.resume(first.time(), first.values());
  danger::march(second, 1.0);
  EXPECT_TRUE(std::equal(whole.values().begin(), whole.values().end(), second.values().begin()));
}

// An ellipse with equal axes, say, reaches as far in every direction but for rounding.
TEST(Solver, RoundingOfHAlongAnAxisIsHarmless) {
  const danger::Grid grid = square(2, 4.0, 41);
  const auto h = danger::sampled<float>(
      grid, [](auto x) { return x[0] + (std::sin(9.0 * x[1]) > 0.0 ? 1e-6 : 0.0); }, 1);
  Solver<float> solver(
      grid, verification::known_flow<float>(grid, verification::DoubleIntegrator{1.0}), h, {});
  danger::march(solver, 1.0);
}

TEST(Solver, RefusesWhatDoesNotFit) {
  const danger::Grid grid = square(2, 2.0, 11);
  const auto h = danger::sampled<float>(
      grid, [](auto x) { return radius(x); }, 1);
  const Flow<float> flow =
      verification::known_flow<float>(grid, verification::DoubleIntegrator{1.0});
  EXPECT_THROW(Solver<float>(grid, flow, std::vector<float>(10), {}), ContractViolation);
  EXPECT_THROW(Solver<float>(grid, flow, h, {.cfl = 0.0}), ContractViolation);
  EXPECT_THROW(Solver<float>(grid, flow, h, {.cfl = 1.1}), ContractViolation);
  EXPECT_THROW(Solver<float>(grid, flow, h, {.threads = 0}), ContractViolation);
  auto holed = h;
  holed[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Solver<float>(grid, flow, holed, {}), ContractViolation);
  EXPECT_THROW((void)verification::known_flow<float>(grid, verification::AnyDirection<3>{1.0}),
               ContractViolation);
  Solver<float> solver(grid, flow, h, {});
  EXPECT_THROW((void)solver.step(0.0), ContractViolation);
  EXPECT_THROW((void)solver.step(std::nan("")), ContractViolation);
}

TEST(MemoryNeeded, IsFourArraysAndLittleMore) {
  const danger::Grid grid = square(3, 1.0, 50);
  const std::size_t needed = memory_needed(grid, sizeof(float), {.threads = 2});
  EXPECT_GT(needed, 4U * 125'000U * 4U);
  EXPECT_LT(needed, 4U * 125'000U * 4U + 100'000U);
  EXPECT_LT(memory_needed(grid, sizeof(float), {.tube = Tube::set}), needed);
}

}  // namespace
}  // namespace saca::levelset::solver_test

#include "saca/reach/avoidance_ahead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/reach/follow.h"
#include "saca/reach/pack.h"

namespace saca::reach {
namespace {

constexpr double pi = std::numbers::pi;
using Number = Pack<double, xsimd::default_arch>;

std::array<Number, 4> packed(const State& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2]), Number(p[3])};
}
double only(const Number& number) {
  std::array<double, Number::size> values{};
  number.store(values.data());
  return values[0];
}
double upwind(const AvoidanceAhead& system, const State& state, const State& lower,
              const State& upper) {
  return only(system.row(state).upwind(Number(state[0]), packed(lower), packed(upper)));
}

struct Draws {
  std::mt19937_64 engine;

  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Avoidance car() {
    return {.grip = in(0.2, 1.0),
            .tightest_curvature = in(0.05, 0.3),
            .drive_share = in(0.0, 1.0),
            .obstacle_speed = engine() % 2 == 0 ? 0.0 : in(-20.0, 20.0)};
  }
  State state() {
    return {in(-40.0, 40.0), in(-40.0, 40.0), in(-pi, pi), engine() % 8 == 0 ? 0.0 : in(0.0, 30.0)};
  }
  State slopes() { return {in(-1.0, 1.0), in(-1.0, 1.0), in(-9.0, 9.0), in(-1.0, 1.0)}; }
};

TEST(SeenByEgo, IsTheObstacleInTheEgosFrame) {
  // The ego 10 m behind the obstacle and 2 m to its right, going along it.
  const State seen = seen_by_ego({-10.0, -2.0, 0.0, 7.0});
  EXPECT_EQ(seen, (State{10.0, 2.0, 0.0, 7.0}));
  // From its right, going left across its way: the obstacle points to the ego's right.
  const State across = seen_by_ego({-1.0, -8.0, 0.5 * pi, 7.0});
  EXPECT_NEAR(across[0], 8.0, 1e-12);
  EXPECT_NEAR(across[1], -1.0, 1e-12);
  EXPECT_NEAR(across[2], -0.5 * pi, 1e-12);
}

TEST(AvoidanceAhead, IsTheSameProblemInOtherCoordinates) {
  Draws draws{std::mt19937_64(31)};
  for (int i = 0; i < 4'000; ++i) {
    const AvoidanceAhead system{draws.car()};
    const State state = draws.state();
    const State seen = seen_by_ego(state);
    const State slopes = draws.slopes();
    const State there = slopes_in_obstacle_frame(seen, slopes);
    const double expected =
        only(system.car.row(state).hamiltonian(Number(state[0]), packed(there)));
    EXPECT_NEAR(only(system.row(seen).hamiltonian(Number(seen[0]), packed(slopes))), expected,
                1e-9 * (1.0 + std::abs(expected)))
        << i;
  }
}

// Slopes carry over as those of any smooth function do.
TEST(AvoidanceAhead, SlopesAreThoseOfTheSameValue) {
  Draws draws{std::mt19937_64(32)};
  const auto value = [](const State& seen) {
    return std::sin(0.3 * seen[0]) * seen[1] + std::cos(seen[2]) * seen[3] + 0.1 * seen[0];
  };
  for (int i = 0; i < 200; ++i) {
    const State state = draws.state();
    const State seen = seen_by_ego(state);
    const State slopes{0.3 * std::cos(0.3 * seen[0]) * seen[1] + 0.1, std::sin(0.3 * seen[0]),
                       -std::sin(seen[2]) * seen[3], std::cos(seen[2])};
    const State found = slopes_in_obstacle_frame(seen, slopes);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      State more = state;
      State less = state;
      more[axis] += 1e-5;
      less[axis] -= 1e-5;
      EXPECT_NEAR(found[axis], (value(seen_by_ego(more)) - value(seen_by_ego(less))) / 2e-5, 1e-5);
    }
  }
}

TEST(AvoidanceAhead, UpwindFallsInTheLowerSlopesAndRisesInTheUpperOnes) {
  Draws draws{std::mt19937_64(33)};
  for (int i = 0; i < 20'000; ++i) {
    const AvoidanceAhead system{draws.car()};
    const State state = draws.state();
    const State lower = draws.slopes();
    const State upper = draws.slopes();
    const double before = upwind(system, state, lower, upper);
    State steeper = lower;
    steeper.at(draws.engine() % 4) += draws.in(0.0, 2.0);
    EXPECT_LE(upwind(system, state, steeper, upper), before + 1e-9) << i;
    steeper = upper;
    steeper.at(draws.engine() % 4) += draws.in(0.0, 2.0);
    EXPECT_GE(upwind(system, state, lower, steeper), before - 1e-9) << i;
  }
}

TEST(AvoidanceAhead, SpeedsBoundTheHamiltoniansSlopes) {
  Draws draws{std::mt19937_64(34)};
  for (int i = 0; i < 4'000; ++i) {
    const AvoidanceAhead system{draws.car()};
    const State state = draws.state();
    const State p = draws.slopes();
    const auto row = system.row(state);
    const auto bounds = row.speeds(Number(state[0]));
    for (std::size_t axis = 0; axis < 4; ++axis) {
      State other = p;
      other.at(axis) += draws.in(-1.0, 1.0);
      const double change = only(row.hamiltonian(Number(state[0]), packed(other))) -
                            only(row.hamiltonian(Number(state[0]), packed(p)));
      EXPECT_LE(std::abs(change),
                only(bounds.at(axis)) * std::abs(other.at(axis) - p.at(axis)) + 1e-9)
          << i << " axis " << axis;
    }
  }
}

}  // namespace
}  // namespace saca::reach

#include "saca/thinking/danger/avoidance_ahead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/thinking/danger/avoidance_for_test.h"

namespace saca::danger::avoidance_ahead_test {
namespace {

constexpr double pi = std::numbers::pi;

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
  AvoidanceDraws draws{std::mt19937_64(31)};
  for (int i = 0; i < 4'000; ++i) {
    const AvoidanceAhead system{draws.system()};
    const State state = draws.state();
    const State seen = seen_by_ego(state);
    const State slopes = draws.gradient();
    const State there = slopes_in_obstacle_frame(seen, slopes);
    const double expected = hamiltonian(system.car, state, there);
    EXPECT_NEAR(hamiltonian(system, seen, slopes), expected, 1e-9 * (1.0 + std::abs(expected)))
        << i;
  }
}

// Slopes carry over as those of any smooth function do.
TEST(AvoidanceAhead, SlopesAreThoseOfTheSameValue) {
  AvoidanceDraws draws{std::mt19937_64(32)};
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

constexpr auto seen_by_car = [](const Avoidance& car) { return AvoidanceAhead{car}; };

TEST(AvoidanceAhead, UpwindFallsInTheLowerSlopesAndRisesInTheUpperOnes) {
  expect_monotone(33, seen_by_car);
}

TEST(AvoidanceAhead, SpeedsBoundTheHamiltoniansSlopes) {
  expect_bounded_by_speeds(34, seen_by_car);
}

}  // namespace
}  // namespace saca::danger::avoidance_ahead_test

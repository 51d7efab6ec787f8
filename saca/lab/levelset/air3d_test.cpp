#include "saca/lab/levelset/air3d.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace saca::levelset::air3d_test {
namespace {

using State3 = std::array<double, 3>;

constexpr Air3d uneven{.evader_speed = 4.0,
                       .pursuer_speed = 6.0,
                       .evader_turn_rate = 0.7,
                       .pursuer_turn_rate = 1.3,
                       .capture_radius = 2.0};

/// The equations of motion, once more and without thought of gradients.
State3 rates(const Air3d& game, const State3& s, double evader, double pursuer) {
  return {-game.evader_speed + game.pursuer_speed * std::cos(s[2]) + evader * s[1],
          game.pursuer_speed * std::sin(s[2]) - evader * s[0], pursuer - evader};
}

double dot(const State3& a, const State3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Draw {
  State3 state, gradient;
};

Draw drawn(std::mt19937& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  return {{20.0 * u(rng), 10.0 * u(rng), std::numbers::pi * (1.0 + u(rng))},
          {u(rng), u(rng), 5.0 * u(rng)}};
}

double hamiltonian(const Air3d& game, const State3& state, const State3& p) {
  return game.row(state).hamiltonian(state[0], p);
}

TEST(Air3d, HamiltonianIsWhatTheBestOfAllTurnRatesGives) {
  std::mt19937 rng(1);
  constexpr int num_inputs = 21;  // the ends among them: rates are linear in the inputs
  const auto input = [](double limit, int i) { return limit * (2.0 * i / (num_inputs - 1) - 1.0); };
  for (int draw = 0; draw < 1'000; ++draw) {
    const auto [state, p] = drawn(rng);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < num_inputs; ++i) {
      double greatest = -std::numeric_limits<double>::infinity();
      for (int j = 0; j < num_inputs; ++j) {
        greatest = std::max(greatest, dot(p, rates(uneven, state, input(uneven.evader_turn_rate, i),
                                                   input(uneven.pursuer_turn_rate, j))));
      }
      least = std::min(least, greatest);
    }
    EXPECT_NEAR(hamiltonian(uneven, state, p), least, 1e-12);
  }
}

TEST(Air3d, NobodyGainsByMovingFirst) {  // else V would depend on who tells whom
  std::mt19937 rng(2);
  for (int draw = 0; draw < 1'000; ++draw) {
    const auto [state, p] = drawn(rng);
    double pursuer_first = -std::numeric_limits<double>::infinity();
    for (const double b : {-uneven.pursuer_turn_rate, uneven.pursuer_turn_rate}) {
      double least = std::numeric_limits<double>::infinity();
      for (const double a : {-uneven.evader_turn_rate, uneven.evader_turn_rate}) {
        least = std::min(least, dot(p, rates(uneven, state, a, b)));
      }
      pursuer_first = std::max(pursuer_first, least);
    }
    EXPECT_NEAR(hamiltonian(uneven, state, p), pursuer_first, 1e-12);
  }
}

TEST(Air3d, SpeedsBoundAndReachTheRates) {
  std::mt19937 rng(3);
  for (int draw = 0; draw < 1'000; ++draw) {
    const State3 state = drawn(rng).state;
    State3 fastest{};
    for (const double a : {-uneven.evader_turn_rate, uneven.evader_turn_rate}) {
      for (const double b : {-uneven.pursuer_turn_rate, uneven.pursuer_turn_rate}) {
        const State3 rate = rates(uneven, state, a, b);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          fastest[axis] = std::max(fastest[axis], std::abs(rate[axis]));
        }
      }
    }
    const State3 speeds = uneven.row(state).speeds(state[0]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(speeds[axis], fastest[axis], 1e-12) << axis;
    }
  }
}

TEST(Air3d, MirroredStateHasTheMirroredHamiltonian) {
  std::mt19937 rng(4);
  for (int draw = 0; draw < 1'000; ++draw) {
    const auto [state, p] = drawn(rng);
    EXPECT_NEAR(hamiltonian(uneven, state, p),
                hamiltonian(uneven, {state[0], -state[1], -state[2]}, {p[0], -p[1], -p[2]}), 1e-12);
  }
}

TEST(Air3d, PursuerThatMayTurnMoreRaisesItAndEvaderLowersIt) {
  std::mt19937 rng(5);
  Air3d better_pursuer = uneven;
  better_pursuer.pursuer_turn_rate *= 1.5;
  Air3d better_evader = uneven;
  better_evader.evader_turn_rate *= 1.5;
  for (int draw = 0; draw < 1'000; ++draw) {
    const auto [state, p] = drawn(rng);
    EXPECT_GT(hamiltonian(better_pursuer, state, p), hamiltonian(uneven, state, p));
    EXPECT_LT(hamiltonian(better_evader, state, p), hamiltonian(uneven, state, p));
  }
}

TEST(Air3d, GridCoversMitchellsRoom) {
  const danger::Grid grid = air3d_grid(51, 40, 50);
  ASSERT_EQ(grid.axes.size(), 3U);
  EXPECT_EQ(grid.axes[0].points, 51);
  EXPECT_EQ(grid.axes[1].points, 40);
  EXPECT_EQ(grid.axes[2].points, 50);
  EXPECT_EQ(grid.axes[2].edge, danger::Edge::periodic);
  EXPECT_EQ(grid.axes[0].first, -6.0);
  EXPECT_EQ(grid.axes[0].last, 20.0);
}

TEST(Air3d, CaughtIsWhoIsWithinTheRadius) {
  const Air3d game;
  EXPECT_DOUBLE_EQ(intrusion(game, State3{3.0, -4.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(intrusion(game, State3{0.0, 0.0, 2.0}), 5.0);
  EXPECT_DOUBLE_EQ(intrusion(game, State3{6.0, 8.0, 0.0}), -5.0);
}

// A straight value is cut exactly wherever the cut falls: x + y / 4 >= 1 in the room of the grid.
TEST(TubeVolume, IsExactForAPlane) {
  const danger::Grid grid = air3d_grid(14, 11, 8);
  const auto values = danger::sampled<double>(
      grid, [](auto x) { return x[0] + 0.25 * x[1] - 1.0; }, 1);
  // mean length 20 - 1 in x, times 20 in y (the slanted end cancels), times 2 pi
  EXPECT_NEAR(tube_volume<double>(grid, values), 19.0 * 20.0 * 2.0 * std::numbers::pi, 1e-9);
}

// The lines' lengths go to zero like a square root at the rim, where the sum's order is 3/2.
TEST(TubeVolume, OfTheCaptureCylinderConverges) {
  const auto error = [](int scale) {
    const danger::Grid grid = air3d_grid(26 * scale + 1, 20 * scale + 1, 4);
    const auto h = danger::sampled<float>(
        grid, [](auto x) { return intrusion({}, x); }, 1);
    return std::abs(tube_volume<float>(grid, h) - 25.0 * std::numbers::pi * 2.0 * std::numbers::pi);
  };
  EXPECT_NEAR(std::log2(error(2) / error(16)) / 3.0, 1.5, 0.1);
  EXPECT_LT(error(16), 0.3);
}

TEST(TubeVolume, IsZeroOrAllOfTheRoom) {
  const danger::Grid grid = air3d_grid(5, 6, 7);
  const std::vector<float> safe(danger::num_cells(grid), -1.0F);
  const std::vector<float> caught(danger::num_cells(grid), 0.0F);
  EXPECT_EQ(tube_volume<float>(grid, safe), 0.0);
  EXPECT_NEAR(tube_volume<float>(grid, caught), 26.0 * 20.0 * 2.0 * std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace saca::levelset::air3d_test

#include "saca/thinking/intent/side_moves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::intent::side_moves_test {
namespace {

/// A move of fifth order, as it is perceived by somebody without noise: its speed, and the
/// acceleration's mean over the past, fading with the law's lag, integrated in steps of 1 ms.
MeasuredSideMove perceived(double size, double time, double share, const SideMoveLaw& law = {}) {
  const auto speed = [&](double x) {
    return x <= 0.0 || x >= 1.0 ? 0.0 : 30.0 * size / time * x * x * (1.0 - x) * (1.0 - x);
  };
  MeasuredSideMove measured{.speed = speed(share), .speed_sd = 0.1};
  constexpr double h = 1e-3;
  double smoothed = 0.0;
  const auto num_steps = static_cast<int>(share * time / h);
  for (int k = 0; k < num_steps; ++k) {
    smoothed += h / law.acceleration_lag * (speed((k + 0.5) * h / time) - smoothed);
  }
  // The fading mean of the acceleration is the speed above its own fading mean, over the lag.
  measured.acceleration = (measured.speed - smoothed) / law.acceleration_lag;
  return measured;
}

double mean_left(const std::vector<SideMove>& moves) {
  double sum = 0.0;
  for (const SideMove& one : moves) {
    sum += one.probability * one.way(100.0);
  }
  return sum;
}

double weight(const std::vector<SideMove>& moves) {
  double sum = 0.0;
  for (const SideMove& one : moves) {
    sum += one.probability;
  }
  return sum;
}

TEST(SideMoves, WeighOneTogetherAndAreSortedByTheirEnds) {
  for (const double speed : {-3.0, -0.4, 0.05, 1.0, 6.0, 40.0}) {
    for (const double acceleration : {-8.0, 0.0, 3.0}) {
      const auto moves = side_moves({.speed = speed, .acceleration = acceleration});
      ASSERT_FALSE(moves.empty());
      EXPECT_NEAR(weight(moves), 1.0, 1e-9) << speed << " " << acceleration;
      for (std::size_t i = 1; i < moves.size(); ++i) {
        EXPECT_LE(moves[i - 1].way(100.0) / speed, moves[i].way(100.0) / speed);
      }
    }
  }
}

TEST(SideMoves, BeginWithTheMeasuredSpeedAndEndAtRest) {
  double speed = 0.0;
  for (const SideMove& one : side_moves(perceived(3.0, 3.0, 0.5))) {
    speed += one.probability * one.speed(0.0);
    EXPECT_EQ(one.way(0.0), 0.0);
    EXPECT_EQ(one.speed(100.0), 0.0);
    EXPECT_EQ(one.way(100.0), one.way(200.0));
    EXPECT_NEAR((one.way(0.5 + 1e-4) - one.way(0.5 - 1e-4)) / 2e-4, one.speed(0.5), 1e-3);
    EXPECT_EQ(one.way_sd(0.0), 0.0);
    EXPECT_NEAR(one.way_sd(100.0), one.left_sd, 1e-12);
  }
  EXPECT_NEAR(speed, 30.0 / 16.0, 0.2) << "that of the middle of the move";
}

// Moves drawn from the law itself, measured with its errors: what is left of them is where it is
// said to be as often as it is said (simulation-based calibration, Talts et al., 2018).
TEST(SideMoves, AreRightAsOftenAsTheySay) {
  const SideMoveLaw law;
  std::mt19937_64 rng(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any;
  constexpr int count = 3'000;
  int below_half = 0;
  int within = 0;
  double error = 0.0;
  for (int i = 0; i < count; ++i) {
    const double size = law.size * normal(rng);
    const double share = any(rng);
    MeasuredSideMove measured =
        perceived(size, law.time * std::exp(law.time_log_sd * normal(rng)), share, law);
    const double left =
        size * (1.0 - share * share * share * (10.0 + share * (6.0 * share - 15.0)));
    measured.speed_sd = 0.2;
    measured.speed += 0.2 * normal(rng);
    measured.acceleration += law.acceleration_sd * normal(rng);
    double before = 0.0;  // probability that less is left
    double mean = 0.0;
    for (const SideMove& one : side_moves(measured, law)) {
      const double z = (left - one.way(100.0)) / std::max(0.02, one.left_sd);
      before += one.probability * 0.5 * std::erfc(-z / std::numbers::sqrt2);
      mean += one.probability * one.way(100.0);
    }
    below_half += before < 0.5 ? 1 : 0;
    within += std::abs(before - 0.5) < 0.45 ? 1 : 0;
    error += mean - left;
  }
  EXPECT_NEAR(below_half, 0.5 * count, 0.03 * count);
  EXPECT_NEAR(within, 0.9 * count, 0.03 * count);
  EXPECT_NEAR(error / count, 0.0, 0.05);
}

// Of the same speed, who brakes sideways is nearer to the end than who speeds up.
TEST(SideMoves, AccelerationTellsHowFarItIs) {
  const auto left = [](double acceleration) {
    return mean_left(side_moves({.speed = 1.2, .speed_sd = 0.2, .acceleration = acceleration}));
  };
  EXPECT_LT(left(-1.0), 0.8 * left(0.0));
  EXPECT_LT(left(0.0), 0.8 * left(1.0));
}

TEST(SideMoves, AreMirroredInTheMirror) {
  const auto left = side_moves({.speed = 0.8, .acceleration = 0.5});
  const auto right = side_moves({.speed = -0.8, .acceleration = -0.5});
  EXPECT_NEAR(mean_left(left), -mean_left(right), 1e-9);
}

TEST(SideMoves, OfALawOutOfRangeAreRefused) {
  EXPECT_THROW((void)side_moves({}, {.time = 0.0}), ContractViolation);
  EXPECT_THROW((void)side_moves({.speed_sd = -1.0}), ContractViolation);
}

// Left is the oncoming driver's own.
TEST(MeasuredSideMove, OfOncomingTrafficIsSeenFromTheDriver) {
  world::Scene scene = test::ego_at(20.0);
  scene.actors.push_back(test::car(1, {40.0, 3.0}, {-15.0, -1.0}));
  scene.actors[0].X_WA.yaw = std::numbers::pi;
  scene.actors[0].a_W = {0.0, 0.5};
  const MeasuredSideMove oncoming =
      measured_side_move(line_of(scene, scene.actors[0]), scene.actors[0]);
  EXPECT_NEAR(oncoming.speed, 1.0, 1e-9);
  EXPECT_NEAR(oncoming.acceleration, -0.5, 1e-9);
}

// In a bend to the left it takes v^2 / R to keep the lane: that is no move to the side.
TEST(MeasuredSideMove, KeepingTheLaneInABendIsNone) {
  world::Scene scene = test::ego_at(20.0);
  scene.road.curvature = 0.01;
  scene.actors.push_back(test::car(1, {0.0, 0.0}, {15.0, 0.0}));
  scene.actors[0].a_W = {0.0, 0.01 * 15.0 * 15.0};
  const MeasuredSideMove measured =
      measured_side_move(line_of(scene, scene.actors[0]), scene.actors[0]);
  EXPECT_NEAR(measured.acceleration, 0.0, 1e-9);
  EXPECT_NEAR(measured.speed, 0.0, 1e-9);
}

}  // namespace
}  // namespace saca::intent::side_moves_test

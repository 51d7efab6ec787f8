#include "saca/thinking/danger/follow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::danger::follow_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double g = 9.80665;
const Avoidance car{.grip = 0.5, .tightest_curvature = 0.2, .drive_share = 0.4};

// v^2 / (2 grip g) after v / (grip g), then nothing: closed form of braking.
TEST(Driven, BrakesToAStopAndStaysThere) {
  const double full = 0.5 * g;
  const State start{1.0, 2.0, 0.3, 10.0};
  const double way = 100.0 / (2.0 * full);
  const State last = driven(car, start, {-full, 0.0}, 3.0);
  EXPECT_EQ(last[3], 0.0);
  EXPECT_NEAR(last[0], 1.0 + way * std::cos(0.3), 1e-9);
  EXPECT_NEAR(last[1], 2.0 + way * std::sin(0.3), 1e-9);
  EXPECT_EQ(last[2], 0.3);
  Avoidance moving = car;
  moving.obstacle_speed = 4.0;  // the frame moves on while it stands
  EXPECT_NEAR(driven(moving, start, {-full, 0.0}, 3.0)[0], last[0] - 12.0, 1e-9);
  const State standing = driven(moving, last, {full, full}, 1.0);
  EXPECT_NEAR(standing[0], last[0] - 4.0, 1e-12);
  EXPECT_EQ(standing[3], 0.0);
}

// A circle of radius v^2 / a_y; beyond the curvature's limit, of 5 m.
TEST(Driven, TurnsOnCircles) {
  const State wide = driven(car, {0.0, 0.0, 0.0, 10.0}, {0.0, 4.0}, 2.0);
  const double radius = 25.0;
  EXPECT_NEAR(wide[0], radius * std::sin(20.0 / radius), 1e-6);
  EXPECT_NEAR(wide[1], radius * (1.0 - std::cos(20.0 / radius)), 1e-6);
  const State tight = driven(car, {0.0, 0.0, 0.0, 2.0}, {0.0, -4.0}, 2.0);
  EXPECT_NEAR(tight[1], -5.0 * (1.0 - std::cos(4.0 / 5.0)), 1e-6);
}

TEST(Driven, StaysWithinTheLimits) {
  std::mt19937_64 draws(21);
  std::uniform_real_distribution<double> speed(0.5, 20.0);
  std::uniform_real_distribution<double> input(-20.0, 20.0);
  constexpr double dt = 1e-4;
  for (int i = 0; i < 500; ++i) {
    const State state{0.0, 0.0, 0.0, speed(draws)};
    const Acceleration wanted{input(draws), input(draws)};
    for (const double after : {0.0, 0.05, 0.09}) {
      const State a = driven(car, state, wanted, after);
      const State b = driven(car, state, wanted, after + dt);
      const double along = (b[3] - a[3]) / dt;
      const double across = (b[2] - a[2]) / dt * a[3];
      EXPECT_LE(along, 0.4 * 0.5 * g + 1e-6);
      EXPECT_LE(std::hypot(along, across), 0.5 * g + 0.01);
      EXPECT_LE(std::abs(across), 0.2 * a[3] * a[3] + 0.01);
    }
  }
}

/// A disc of radius 1 m beside an edge along x at y = 0, whose value is known while the car goes
/// along the edge at 5 m/s or more (`avoidance_case_test.cpp`).
double over_the_edge(const State& state) {
  return state[1] + 1.0;
}
double value_at_edge(const State& state) {
  const double onto = state[3] * std::max(0.0, std::sin(state[2]));
  return state[1] + 1.0 + onto * onto / g;
}
State slopes_at_edge(const State& state) {
  const double onto = state[3] * std::max(0.0, std::sin(state[2]));
  return {0.0, 1.0, 2.0 * onto * state[3] * std::cos(state[2]) / g,
          2.0 * onto * std::max(0.0, std::sin(state[2])) / g};
}

TEST(Follow, DoesWhatAKnownValueSays) {
  std::mt19937_64 draws(22);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  const Steering by_slopes = by_gradient(car, slopes_at_edge);
  const Steering by_look = by_look_ahead(car, value_at_edge, 0.1, 48);
  for (int i = 0; i < 200; ++i) {
    const double along = in(6.0, 12.0);
    const double onto = in(0.0, 8.0);
    const State start{0.0, in(-12.0, -1.0), std::atan2(onto, along), std::hypot(along, onto)};
    const double expected = value_at_edge(start);
    for (const Steering& steering : {by_slopes, by_look}) {
      const EvasionPath way = follow(car, over_the_edge, steering, start, {1.0, 0.02, 10.0});
      EXPECT_GE(way.highest, expected - 1e-4) << i;  // none is better; 10 ms between looks
      EXPECT_LE(way.highest, expected + 0.05) << i;  // 48 directions, steps of 20 ms
      EXPECT_TRUE(way.is_settled || way.highest > 0.0) << i;
    }
  }
}

// Whoever brakes all the time meets the highest intrusion at the end.
TEST(Follow, LooksBetweenItsSteps) {
  const Steering coast = [](const State&) { return Acceleration{}; };
  const auto disc = [](const State& state) { return 2.0 - std::hypot(state[0], state[1]); };
  // Passes the disc's centre at 1 m, in steps of 6 m.
  const EvasionPath way = follow(car, disc, coast, {-20.0, 1.0, 0.0, 20.0}, {1.0, 0.3, 5.0});
  EXPECT_NEAR(way.highest, 1.0, 0.01);
  EXPECT_TRUE(way.is_settled);
  EXPECT_LT(way.duration, 2.0);
}

TEST(Follow, RefusesWhatIsNoDrive) {
  const Steering coast = [](const State&) { return Acceleration{}; };
  EXPECT_THROW((void)follow(car, over_the_edge, coast, {}, {0.0, 0.1, 1.0}), ContractViolation);
  EXPECT_THROW((void)follow(car, over_the_edge, coast, {}, {1.0, 0.0, 1.0}), ContractViolation);
  EXPECT_THROW((void)follow(car, over_the_edge, coast, {}, {1.0, 0.1, 0.0}), ContractViolation);
  EXPECT_THROW((void)by_look_ahead(car, over_the_edge, 0.0), ContractViolation);
  EXPECT_THROW((void)driven(car, {}, {}, -1.0), ContractViolation);
}

}  // namespace
}  // namespace saca::danger::follow_test

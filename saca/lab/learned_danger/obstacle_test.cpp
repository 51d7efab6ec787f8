#include "saca/lab/learned_danger/obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace saca::learned_danger::obstacle_test {
namespace {

Obstacle car(double speed, double acceleration, double curvature) {
  return {.body = {.length = 4.5, .width = 1.8},
          .X_WO = {{3.0, -2.0}, 0.5},
          .speed = speed,
          .acceleration = acceleration,
          .curvature = curvature};
}

TEST(Obstacle, GoesStraightAsFarAsItsSpeedsSay) {
  const Obstacle later = after(car(10.0, 2.0, 0.0), 3.0);
  EXPECT_NEAR(later.speed, 16.0, 1e-12);
  const double way = 10.0 * 3.0 + 0.5 * 2.0 * 9.0;
  EXPECT_NEAR(later.X_WO.p.x, 3.0 + way * std::cos(0.5), 1e-9);
  EXPECT_NEAR(later.X_WO.p.y, -2.0 + way * std::sin(0.5), 1e-9);
  EXPECT_NEAR(later.X_WO.yaw, 0.5, 1e-12);
}

// 10 m/s at -5 m/s^2: 10 m in 2 s, and there it stays.
TEST(Obstacle, StandsWhereItHasBrakedToRest) {
  const Obstacle at_rest = after(car(10.0, -5.0, 0.1), 2.0);
  const Obstacle later = after(car(10.0, -5.0, 0.1), 7.0);
  EXPECT_EQ(later.speed, 0.0);
  EXPECT_EQ(later.X_WO, at_rest.X_WO);
  EXPECT_NEAR(later.X_WO.yaw, 0.5 + 0.1 * 10.0, 1e-12);
  const Obstacle never_moved = after(car(0.0, -5.0, 0.1), 4.0);
  EXPECT_EQ(never_moved.X_WO, car(0.0, 0.0, 0.1).X_WO);
}

// A quarter of a circle of 20 m to the right ends 20 m ahead and 20 m to the right.
TEST(Obstacle, TurnsOnItsCircle) {
  const double time = 0.5 * std::numbers::pi * 20.0 / 8.0;
  const Obstacle later = after(car(8.0, 0.0, -1.0 / 20.0), time);
  const Vec2 there = car(0.0, 0.0, 0.0).X_WO * Vec2{20.0, -20.0};
  EXPECT_NEAR(later.X_WO.p.x, there.x, 1e-9);
  EXPECT_NEAR(later.X_WO.p.y, there.y, 1e-9);
  EXPECT_NEAR(later.X_WO.yaw, 0.5 - 0.5 * std::numbers::pi, 1e-12);
}

TEST(Obstacle, GoesOnFromAnyMoment) {
  const Obstacle at_once = after(car(12.0, -4.0, 0.02), 4.0);
  const Obstacle in_steps = after(after(car(12.0, -4.0, 0.02), 1.3), 2.7);
  EXPECT_NEAR(at_once.X_WO.p.x, in_steps.X_WO.p.x, 1e-9);
  EXPECT_NEAR(at_once.X_WO.p.y, in_steps.X_WO.p.y, 1e-9);
  EXPECT_NEAR(at_once.speed, in_steps.speed, 1e-12);
}

}  // namespace
}  // namespace saca::learned_danger::obstacle_test

#include "saca/thinking/intent/line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::intent::line_test {
namespace {

using test::car;
using world::Actor;
using world::Scene;

constexpr double pi = std::numbers::pi;

TEST(Line, IsThatOfTheLaneTheActorDrivesAlong) {
  const Line line = line_of(Scene(), car(1, {30.0, 4.0}, {15.0, 0.6}));
  EXPECT_TRUE(line.along_lane);
  EXPECT_NEAR(line.lateral, 0.6, 1e-12);
  EXPECT_NEAR(line.offset, 0.5, 1e-12);  // the next lane's centre lies at 3.5 m
  EXPECT_NEAR(line.speed, std::hypot(15.0, 0.6), 1e-12);
  EXPECT_EQ(line.road.X_WL.yaw, 0.0);
}

TEST(Line, OfOncomingTrafficRunsItsWay) {
  const Line line = line_of(Scene(), car(1, {60.0, 4.0}, {-15.0, 0.6}));
  EXPECT_TRUE(line.along_lane);
  EXPECT_NEAR(line.lateral, -0.6, 1e-12);  // to its right
  EXPECT_NEAR(line.offset, -0.5, 1e-12);
  EXPECT_NEAR(std::abs(line.road.X_WL.yaw), pi, 1e-12);
}

TEST(Line, OfWhoCrossesIsItsOwnArc) {
  Actor actor = car(1, {16.0, 6.4}, {0.0, -7.5});
  actor.yaw_rate = 0.15;
  actor.X_WA.yaw += 0.1;
  actor.a_W = {0.3, 3.0};
  const Line line = line_of(Scene(), actor);
  EXPECT_FALSE(line.along_lane);
  EXPECT_NEAR(line.road.curvature, 0.15 / 7.5, 1e-12);
  EXPECT_NEAR(line.crab, 0.1, 1e-12);
  EXPECT_NEAR(line.deceleration, 3.0, 1e-12);
  EXPECT_EQ(line.lateral, 0.0);
}

TEST(Line, RefusesWhoIsAtRest) {
  EXPECT_THROW((void)line_of(Scene(), car(1, {}, {0.05, 0.0})), ContractViolation);
}

}  // namespace
}  // namespace saca::intent::line_test

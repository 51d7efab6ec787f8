#include "saca/thinking/preview/moved_along.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace saca::preview::moved_along_test {
namespace {

// On a circle of radius r at speed v: acceleration v^2 / r towards the centre, turning v / r.
TEST(MovedAlong, ACircleGivesSpeedTurningAndCentripetalAcceleration) {
  constexpr double r = 20.0;
  constexpr double v = 10.0;
  world::Track track{.start = 3.0, .step = 0.05, .X_WA = {}};
  for (int k = 0; k <= 60; ++k) {
    const double angle = v / r * 0.05 * k;
    track.X_WA.push_back({{r * std::sin(angle), r - r * std::cos(angle)}, angle});
  }
  const world::Actor moved = moved_along(test::car(1, {0.0, 0.0}, {v, 0.0}), track, 4.0);
  const double angle = v / r;
  EXPECT_NEAR(moved.X_WA.p.x, r * std::sin(angle), 1e-6);
  EXPECT_NEAR(moved.v_W.x, v * std::cos(angle), 2e-3);
  EXPECT_NEAR(moved.v_W.y, v * std::sin(angle), 2e-3);
  EXPECT_NEAR(moved.a_W.x, -v * v / r * std::sin(angle), 2e-3);
  EXPECT_NEAR(moved.a_W.y, v * v / r * std::cos(angle), 2e-3);
  EXPECT_NEAR(moved.yaw_rate, v / r, 1e-6);
}

TEST(MovedAlong, InTheFirstStepMotionIsAsPerceived) {
  const world::Actor seen = test::car(1, {0.0, 0.0}, {7.0, 1.0});
  const world::Track track{
      .start = 0.0, .step = 0.05, .X_WA = {{{0.0, 0.0}, 0.0}, {{9.0, 0.0}, 0.0}}};
  const world::Actor moved = moved_along(seen, track, 0.02);
  EXPECT_EQ(moved.v_W.x, 7.0);
  EXPECT_EQ(moved.v_W.y, 1.0);
}

}  // namespace
}  // namespace saca::preview::moved_along_test

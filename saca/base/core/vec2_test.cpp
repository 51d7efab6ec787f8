#include "saca/base/core/vec2.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace saca::vec2_test {
namespace {

TEST(Vec2, RotatesCounterClockwise) {
  const Vec2 left = rotated({1.0, 0.0}, std::numbers::pi / 2.0);
  EXPECT_NEAR(left.x, 0.0, 1e-15);
  EXPECT_NEAR(left.y, 1.0, 1e-15);
}

TEST(Vec2, RotationKeepsTheLength) {
  for (int i = -10; i <= 10; ++i) {
    const double angle = 0.37 * i;
    EXPECT_NEAR(norm(rotated({3.0, -4.0}, angle)), 5.0, 1e-14) << "angle " << angle;
  }
}

TEST(Vec2, KnowsWhenItIsNotFinite) {
  EXPECT_TRUE(is_finite(Vec2{1.0, 2.0}));
  EXPECT_FALSE(is_finite(Vec2{std::numeric_limits<double>::infinity(), 0.0}));
}

}  // namespace
}  // namespace saca::vec2_test

#include "saca/base/core/angle.h"

#include <gtest/gtest.h>

namespace saca::angle_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(WrapAngle, LeavesItsOwnRangeAlone) {
  for (const double angle : {-3.0, -1.0, 0.0, 1.0, 3.0, pi}) {
    EXPECT_DOUBLE_EQ(wrap_angle(angle), angle);
  }
}

TEST(WrapAngle, IncludesPlusPiAndExcludesMinusPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(-pi), pi);
  EXPECT_DOUBLE_EQ(wrap_angle(3.0 * pi), pi);
}

TEST(WrapAngle, KeepsTheDirection) {
  for (int i = -50; i <= 50; ++i) {
    const double angle = 0.73 * i;
    EXPECT_NEAR(std::cos(wrap_angle(angle)), std::cos(angle), 1e-13);
    EXPECT_NEAR(std::sin(wrap_angle(angle)), std::sin(angle), 1e-13);
  }
}

}  // namespace
}  // namespace saca::angle_test

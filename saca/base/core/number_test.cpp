#include "saca/base/core/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace saca::number_test {
namespace {

TEST(Number, MasksOfOneNumberAreBools) {
  EXPECT_TRUE(number::any(true));
  EXPECT_TRUE(number::all(true));
  EXPECT_FALSE(number::any(false));
  EXPECT_FALSE(number::all(false));
  EXPECT_EQ(number::select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(number::select(false, 1.0, 2.0), 2.0);
}

TEST(Number, ClampsToBothEnds) {
  EXPECT_EQ(number::clamp(-3.0, -1.0, 2.0), -1.0);
  EXPECT_EQ(number::clamp(3.0, -1.0, 2.0), 2.0);
  EXPECT_EQ(number::clamp(0.5, -1.0, 2.0), 0.5);
  EXPECT_EQ(number::min(1.0, 2.0), 1.0);
  EXPECT_EQ(number::max(1.0, 2.0), 2.0);
}

TEST(Number, FunctionsAreTheirNamesakes) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  EXPECT_EQ(number::abs(-2.5), 2.5);
  EXPECT_EQ(number::round(-2.6), -3.0);
  EXPECT_EQ(number::sqrt(6.25), 2.5);
  EXPECT_EQ(number::hypot(3.0, -4.0), 5.0);
  EXPECT_DOUBLE_EQ(number::sin(quarter / 3.0), 0.5);
  EXPECT_DOUBLE_EQ(number::cos(2.0 * quarter / 3.0), 0.5);
  EXPECT_DOUBLE_EQ(number::tan(0.5 * quarter), 1.0);
  EXPECT_DOUBLE_EQ(number::asin(1.0), quarter);
  EXPECT_DOUBLE_EQ(number::atan2(1.0, 0.0), quarter);
  EXPECT_DOUBLE_EQ(number::atan2(1.0, -1.0), 1.5 * quarter);
}

}  // namespace
}  // namespace saca::number_test

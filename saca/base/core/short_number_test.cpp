#include "saca/base/core/short_number.h"

#include <gtest/gtest.h>

#include <limits>

namespace saca::short_number_test {
namespace {

TEST(ShortNumber, LeavesOutWhatArithmeticAdded) {
  EXPECT_EQ(short_number(3.0 * 0.2), 0.6);
  EXPECT_NE(3.0 * 0.2, 0.6);
  EXPECT_EQ(short_number(0.1 + 0.2), 0.3);
  EXPECT_EQ(short_number(-1.4e-17), 0.0);
  EXPECT_FALSE(std::signbit(short_number(-1.4e-17)));
}

TEST(ShortNumber, KeepsTwelveDigits) {
  EXPECT_EQ(short_number(123456.789012), 123456.789012);
  EXPECT_EQ(short_number(-1.0 / 3.0), -0.333333333333);
  EXPECT_EQ(short_number(1e300), 1e300);
  EXPECT_EQ(short_number(2.5e-9), 2.5e-9);
  EXPECT_TRUE(std::isnan(short_number(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(short_number(std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace saca::short_number_test

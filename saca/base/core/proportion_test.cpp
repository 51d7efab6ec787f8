#include "saca/base/core/proportion.h"

#include <gtest/gtest.h>

namespace saca::proportion_test {
namespace {

// R. G. Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine
// 17 (1998), table I, method 3 (score without continuity correction).
TEST(Proportion, HasThePublishedIntervals) {
  const Proportion a = proportion(81, 263);
  EXPECT_NEAR(a.low, 0.2553, 5e-5);
  EXPECT_NEAR(a.high, 0.3662, 5e-5);
  const Proportion b = proportion(15, 148);
  EXPECT_NEAR(b.low, 0.0624, 5e-5);
  EXPECT_NEAR(b.high, 0.1605, 5e-5);
  const Proportion c = proportion(0, 20);
  EXPECT_NEAR(c.low, 0.0, 1e-12);
  EXPECT_NEAR(c.high, 0.1611, 5e-5);
  const Proportion d = proportion(1, 29);
  EXPECT_NEAR(d.low, 0.0061, 5e-5);
  EXPECT_NEAR(d.high, 0.1718, 5e-5);
}

TEST(Proportion, OfNothingIsRefused) {
  EXPECT_THROW((void)proportion(0, 0), ContractViolation);
  EXPECT_THROW((void)proportion(5, 4), ContractViolation);
}

}  // namespace
}  // namespace saca::proportion_test

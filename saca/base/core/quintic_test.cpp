#include "saca/base/core/quintic.h"

#include <gtest/gtest.h>

namespace saca::quintic_test {
namespace {

TEST(Quintic, LeadsFromZeroToOneAndRestsThere) {
  for (const double x : {-2.0, 0.0}) {
    EXPECT_EQ(quintic(x), 0.0);
  }
  for (const double x : {1.0, 3.0}) {
    EXPECT_EQ(quintic(x), 1.0);
  }
  EXPECT_EQ(quintic(0.5), 0.5);
  for (const double x : {-1.0, 0.0, 1.0, 2.0}) {
    EXPECT_EQ(quintic_slope(x), 0.0);
    EXPECT_EQ(quintic_curvature(x), 0.0);
  }
}

TEST(Quintic, SlopeAndCurvatureAreItsDerivatives) {
  constexpr double h = 1e-5;
  for (const double x : {0.1, 0.3, 0.5, 0.8}) {
    EXPECT_NEAR(quintic_slope(x), (quintic(x + h) - quintic(x - h)) / (2.0 * h), 1e-8);
    EXPECT_NEAR(quintic_curvature(x), (quintic_slope(x + h) - quintic_slope(x - h)) / (2.0 * h),
                1e-7);
  }
}

}  // namespace
}  // namespace saca::quintic_test

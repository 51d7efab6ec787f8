#include "saca/base/core/units.h"

#include <gtest/gtest.h>

namespace saca::units_test {
namespace {

TEST(Units, AgreeWithTheirDefinitions) {
  EXPECT_DOUBLE_EQ(from_kmh(36.0), 10.0);
  EXPECT_DOUBLE_EQ(from_mph(1.0), 1609.344 / 3600.0);
  EXPECT_DOUBLE_EQ(from_feet(3.0), 0.9144);  // one yard
  EXPECT_DOUBLE_EQ(from_inches(12.0), from_feet(1.0));
  EXPECT_DOUBLE_EQ(from_g(1.0), 9.80665);
  EXPECT_DOUBLE_EQ(from_degrees(180.0), std::numbers::pi);
}

TEST(Units, GoThereAndBack) {
  for (const double x : {-12.5, 0.0, 3.0, 250.0}) {
    EXPECT_NEAR(to_kmh(from_kmh(x)), x, 1e-12);
    EXPECT_NEAR(to_degrees(from_degrees(x)), x, 1e-12);
  }
}

}  // namespace
}  // namespace saca::units_test

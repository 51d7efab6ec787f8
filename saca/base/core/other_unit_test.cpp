#include "saca/base/core/other_unit.h"

#include <gtest/gtest.h>

#include <limits>

namespace saca::other_unit_test {
namespace {

TEST(OtherUnitHint, AsksForTheUnitInWhichTheNumberWouldBeInRange) {
  EXPECT_EQ(other_unit_hint(130.0, 0.0, 100.0, "m/s"),
            " (did you mean km/h? that would be 36.1 m/s)");  // 130 / 3.6
  EXPECT_EQ(other_unit_hint(90.0, 0.05, 1.2, "-"), " (did you mean %? that would be 0.9)");
  EXPECT_EQ(other_unit_hint(4200.0, 0.0, 600.0, "s"), " (did you mean ms? that would be 4.2 s)");
  EXPECT_EQ(other_unit_hint(12.0, 1000.0, 100'000.0, "kg"),
            " (did you mean t? that would be 12000 kg)");
}

TEST(OtherUnitHint, IsSilentWhereNoUnitHelps) {
  EXPECT_EQ(other_unit_hint(-3.0, 0.0, 100.0, "m/s"), "");
  EXPECT_EQ(other_unit_hint(1000.0, 0.0, 100.0, "m/s"), "");
  EXPECT_EQ(other_unit_hint(130.0, 0.0, 100.0, "m"), "");
  EXPECT_EQ(other_unit_hint(std::numeric_limits<double>::quiet_NaN(), 0.0, 100.0, "m/s"), "");
}

}  // namespace
}  // namespace saca::other_unit_test

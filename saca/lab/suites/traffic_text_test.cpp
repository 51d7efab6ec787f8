#include "saca/lab/suites/traffic_text.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/traffic_for_test.h"

namespace saca::suites::traffic_text_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(TrafficText, HasALineForEachSourceAndForAll) {
  const std::string text = traffic_text(made_traffic());
  EXPECT_THAT(text, StartsWith("SACA in shadow: 3 of 12 recorded drives; rates with exact 95 % "
                               "intervals\n\nsource "));
  EXPECT_THAT(text,
              HasSubstr("\ni80               1    0.500     20.00        1        2      1 "));
  EXPECT_THAT(text, HasSubstr("\nall               2    1.000     50.00 "));
  EXPECT_THAT(text, HasSubstr("\n1 of the times that SACA acts come before T1.\n\nTriggers:\n"));
  EXPECT_THAT(text, HasSubstr("     1 danger the driver braked"));
  EXPECT_THAT(
      text,
      HasSubstr(
          "\n     1 drives could not be watched, in 0 of them SACA failed: the page tells why\n"));
}

TEST(TrafficText, SaysNothingOfDrivesLeftOutWhereThereIsNone) {
  WatchedTraffic traffic = made_traffic();
  traffic.rows.pop_back();
  traffic.drives.pop_back();
  EXPECT_THAT(traffic_text(traffic), Not(HasSubstr("could not be watched")));
}

TEST(TrafficText, ARateHasItsBounds) {
  EXPECT_EQ(with_bounds({.count = 1, .value = 1.25, .low = 0.0, .high = 9.5}), "1.2 (0.0 to 9.5)");
}

}  // namespace
}  // namespace saca::suites::traffic_text_test

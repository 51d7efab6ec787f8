#include "saca/lab/crash_records/recorded_speed.h"

#include <gmock/gmock.h>

#include "saca/base/core/units.h"
#include "saca/lab/crash_records/records_for_test.h"

namespace saca::crash_records::recorded_speed_test {
namespace {

using testing::StartsWith;

RecordedSpeed of(std::optional<int> travel_speed) {
  FarsVehicle vehicle = car_record(1, 24, 51);
  vehicle.travel_speed = travel_speed;
  return recorded_speed(vehicle, SpeedRole::oncoming, shipped_codes(), "other's").value();
}

TEST(RecordedSpeed, IsRightToATenthAndToItsRounding) {
  EXPECT_NEAR(of(60).span.min, from_mph(54.0), 1e-9);
  EXPECT_NEAR(of(60).span.max, from_mph(66.0), 1e-9);
  EXPECT_NEAR(of(10).span.max, from_mph(12.5), 1e-9) << "rounded to 5 mph";
  EXPECT_NEAR(of(3).span.max, from_mph(3.5), 1e-9) << "rounded to 1 mph";
  EXPECT_EQ(of(0).span.min, 0.0);
  EXPECT_TRUE(of(60).recorded);
  EXPECT_THAT(of(60).source, StartsWith("recorded: other's TRAV_SP 60 mph"));
  EXPECT_NEAR(of(60).middle(), from_mph(60.0), 1e-9);
}

TEST(RecordedSpeed, ElseIsAShareOfTheLimit) {
  const RecordedSpeed speed = of(std::nullopt);
  EXPECT_FALSE(speed.recorded);
  EXPECT_NEAR(speed.span.min,
              shipped_codes().speed_over_limit(SpeedRole::oncoming).min * from_mph(45.0), 1e-9);
  EXPECT_THAT(speed.source, StartsWith("assumption: "));
  FarsVehicle nothing = car_record(1, 24, 51);
  nothing.travel_speed = std::nullopt;
  nothing.speed_limit = std::nullopt;
  EXPECT_FALSE(recorded_speed(nothing, SpeedRole::slower, shipped_codes(), "ego's").has_value());
}

}  // namespace
}  // namespace saca::crash_records::recorded_speed_test

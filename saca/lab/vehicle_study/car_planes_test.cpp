#include "saca/lab/vehicle_study/car_planes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::vehicle_study::car_planes_test {
namespace {

using testing::HasSubstr;

TEST(CarPlanes, PointToWhatTheyHold) {
  const reflex::Thresholds late{.trigger = 1.0};
  const auto opened = open_planes(installation::here_for_test(), "compact_rwd_ev", late);
  ASSERT_TRUE(opened.has_value());
  const PlanesOfCar& planes = *opened.value();
  EXPECT_EQ(planes.setup.forecast.car, &planes.inputs.car);
  EXPECT_EQ(planes.setup.forecast.harm, &planes.inputs.harm);
  EXPECT_EQ(planes.setup.forecast.atlas, &planes.atlas);
  EXPECT_EQ(planes.setup.forecast.cues, &planes.inputs.cues);
  EXPECT_EQ(planes.setup.clock, &planes.clock);
  EXPECT_EQ(planes.setup.thresholds.trigger, 1.0);
  EXPECT_EQ(planes.setup.memory, nullptr);
  EXPECT_EQ(planes.setup.model, nullptr);
  EXPECT_FALSE(made_with(planes).empty());
}

TEST(CarPlanes, NeedACarThatIsThere) {
  EXPECT_THAT(open_planes(installation::here_for_test(), "no_car").error().message,
              HasSubstr("no_car: no car"));
}

}  // namespace
}  // namespace saca::vehicle_study::car_planes_test

#include "saca/lab/eval/forecast_fan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "tests/support/scenes.h"

namespace saca::eval::forecast_fan_test {
namespace {

using testing::HasSubstr;

class ForecastFanTest : public testing::Test {
 protected:
  [[nodiscard]] Result<ForecastFan> fan(std::string_view who, double time) const {
    return forecast_fan({&scenario_, &car_, &harm_, &intent::shipped_model(), {}, {}}, who, time);
  }

  scenario::Scenario scenario_ = car_that_brakes();
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
};

TEST_F(ForecastFanTest, HoldsWhatWasForecastAndWhatHappened) {
  const ForecastFan told = fan("car1", 2.0).value();
  EXPECT_NEAR(told.seen.time, 2.0, 1e-9);
  double sum = 0.0;
  for (const ForecastFan::Way& way : told.ways) {
    EXPECT_NEAR(way.forecast.track.start, 2.0, 1e-9);
    EXPECT_GE(world::end_time(way.forecast.track), 5.0 - 1e-9);
    sum += way.probability;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // By hand: the ego makes 20 m/s x 3 s; the car ahead 20 x 3 - 6 / 2 x 3^2.
  EXPECT_NEAR(pose_at(told.ego, 5.0).p.x - pose_at(told.ego, 2.0).p.x, 60.0, 0.1);
  const world::Track& car = told.others.at(told.actor);
  EXPECT_NEAR(pose_at(car, 5.0).p.x - pose_at(car, 2.0).p.x, 33.0, 0.3);
}

TEST_F(ForecastFanTest, EndsWithTheEncounter) {
  const ForecastFan told = fan("car1", 5.0).value();
  EXPECT_NEAR(world::end_time(told.ego), 6.0, 0.02);
  EXPECT_EQ(told.others.at(0).X_WA.size(), told.ego.X_WA.size());
}

TEST_F(ForecastFanTest, SaysWhoIsPerceived) {
  EXPECT_THAT(fan("truck7", 2.0).error().message, HasSubstr("at 2 s: car1, got \"truck7\""));
  EXPECT_THAT(fan("car1", 60.0).error().message, HasSubstr("ends at 6 s, got 60 s"));
  EXPECT_THAT(fan("car1", -1.0).error().message, HasSubstr("begins at 0 s, got -1 s"));
}

}  // namespace
}  // namespace saca::eval::forecast_fan_test

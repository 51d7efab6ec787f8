#include "saca/lab/forecast_study/fan_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::forecast_study::fan_picture_test {
namespace {

using testing::HasSubstr;

eval::ForecastFan fan_of_a_braking_car() {
  const scenario::Scenario scenario = eval::car_that_brakes();
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = eval::shipped_harm();
  return eval::forecast_fan({&scenario, &car, &harm, &intent::shipped_model(), {}, {}}, "car1", 2.0)
      .value();
}

TEST(FanView, CountsTheLikelyWays) {
  eval::ForecastFan fan = fan_of_a_braking_car();
  fan.ways.resize(1);
  fan.ways.push_back(fan.ways[0]);
  fan.ways.push_back(fan.ways[0]);
  fan.ways[0].probability = 0.98;
  fan.ways[1].probability = 0.011;
  fan.ways[2].probability = 0.009;
  const report::SceneView two = fan_view(fan, "car1", "queue 3");
  EXPECT_EQ(two.title, "queue 3: what may come of car1, and what came");
  EXPECT_THAT(two.lines.at(0), testing::StartsWith("At 2.0 s 2 ways are likely, "));
  ASSERT_EQ(two.fan.size(), 3U) << "the unlikely are drawn, too";
  EXPECT_EQ(two.fan[2].probability, 0.009);
  EXPECT_EQ(two.others.size(), fan.seen.actors.size());
  fan.ways[1].probability = 0.0;
  EXPECT_THAT(fan_view(fan, "car1", "").lines.at(0), HasSubstr(" 1 way is likely, "));
}

TEST(FanPicture, DrawsEveryWay) {
  const eval::ForecastFan fan = fan_of_a_braking_car();
  const std::string picture = fan_picture(fan, "car1", "queue 3");
  EXPECT_THAT(picture, testing::StartsWith("<svg"));
  EXPECT_THAT(picture, HasSubstr("queue 3: what may come of car1, and what came"));
  std::size_t ways = 0;
  for (std::size_t at = picture.find("class=\"fan\""); at != std::string::npos;
       at = picture.find("class=\"fan\"", at + 1)) {
    ++ways;
  }
  EXPECT_EQ(ways, fan.ways.size());
}

}  // namespace
}  // namespace saca::forecast_study::fan_picture_test

#include "saca/thinking/danger/danger_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "saca/base/core/contract.h"

namespace saca::danger::danger_cases_test {
namespace {

using testing::ElementsAre;
using world::Footprint;
using world::Shape;

constexpr Avoidance car{.grip = 0.9, .tightest_curvature = 0.235, .drive_share = 0.48};
constexpr Footprint ego{.length = 4.7, .width = 1.9, .centre_x = -0.1};

std::vector<std::string> names(double grip, std::vector<ObstacleKind> wanted) {
  std::vector<std::string> found;
  for (const DangerCase& one : danger_cases(car, ego, grip, wanted).value()) {
    found.push_back(one.name);
  }
  return found;
}

TEST(DangerCases, AreOfTheBodyNearestToWhatIsThere) {
  EXPECT_THAT(names(0.9, {{{.length = 4.4, .width = 1.8}, 0.0}}), ElementsAre("car_0mps"));
  EXPECT_THAT(names(0.9, {{{.length = 0.5, .width = 0.5}, 0.0}}), ElementsAre("person_0mps"));
  EXPECT_THAT(names(0.9, {{{.length = 1.8, .width = 0.6}, 0.0}}), ElementsAre("person_0mps"));
  EXPECT_THAT(names(0.9, {{{.length = 8.5, .width = 2.5}, 0.0}}), ElementsAre("truck_0mps"));
  EXPECT_THAT(names(0.9, {{{.length = 18.0, .width = 2.5}, 0.0}}), ElementsAre("articulated_0mps"));
  EXPECT_THAT(names(0.9, {}), testing::IsEmpty());
}

// With 1 m/s to spare: perception's noise, and forecasts, make it seem faster.
TEST(DangerCases, ReachBeyondTheTopSpeedAndOnlyOnce) {
  const Footprint body{.length = 4.8, .width = 1.9};
  EXPECT_THAT(names(0.9, {{body, 9.0}, {body, 3.0}}),
              ElementsAre("car_0mps", "car_5mps", "car_10mps"));
  EXPECT_THAT(names(0.9, {{body, 9.0 + 1e-12}}), testing::SizeIs(3));
  EXPECT_THAT(names(0.9, {{body, 9.1}}), testing::SizeIs(4));
}

// On a quarter of the grip a speed counts twice.
TEST(DangerCases, OnLessGripReachFarther) {
  const Footprint body{.length = 4.8, .width = 1.9};
  EXPECT_THAT(names(0.225, {{body, 9.5}}), testing::SizeIs(5));
  EXPECT_EQ(names(1.2, {{body, 9.0}}), names(0.9, {{body, 9.0}})) << "more is taken as the tables'";
}

// 30 m/s on ice count as 30 * sqrt(0.9 / 0.1) = 90: more than a case may hold.
TEST(DangerCases, EndAtTheFastestObstacleThatACaseMayHold) {
  const Footprint body{.length = 4.8, .width = 1.9};
  EXPECT_THAT(names(0.1, {{body, 30.0}}),
              testing::AllOf(testing::SizeIs(13), testing::Contains("car_60mps")));
  EXPECT_EQ(names(0.1, {{body, 1e300}}), names(0.1, {{body, 30.0}}));
}

TEST(DangerCases, SayWhatACaseMayNotHold) {
  const std::vector<ObstacleKind> wanted{{{.length = 4.8, .width = 1.9}, 2.0}};
  Avoidance spinning = car;
  spinning.tightest_curvature = 3.0;
  EXPECT_THAT(danger_cases(spinning, ego, 0.9, wanted).error().message,
              testing::HasSubstr("tightest_curvature_1pm"));
  EXPECT_THAT(danger_cases(car, {.length = 50.0, .width = 1.9}, 0.9, wanted).error().message,
              testing::HasSubstr("length_m"));
}

TEST(DangerCases, HoldWhatTheyWereAskedFor) {
  const auto cases =
      danger_cases(car, ego, 0.9, std::vector<ObstacleKind>{{{.length = 4.8, .width = 1.9}, 2.0}})
          .value();
  ASSERT_EQ(cases.size(), 2U);
  const AvoidanceCase& asked = cases[1].asked;
  EXPECT_EQ(asked.system.obstacle_speed, 5.0);
  EXPECT_EQ(asked.system.drive_share, 0.48);
  EXPECT_EQ(asked.ego.centre_x, -0.1);
  EXPECT_EQ(asked.obstacle->length, 4.8);
  EXPECT_EQ(num_cells(asked.grid), 48U * 26U * 36U * 13U);
  EXPECT_NE(cases[0].asked.text, asked.text);
  EXPECT_THROW((void)danger_cases(car, ego, 0.9, std::vector<ObstacleKind>{{ego, -1.0}}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::danger::danger_cases_test

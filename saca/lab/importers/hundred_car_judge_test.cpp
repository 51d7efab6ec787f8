#include "saca/lab/importers/hundred_car_judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace saca::importers::hundred_car_judge_test {
namespace {

using testing::HasSubstr;

TEST(HundredCarReason, EachHasANameAndAMeaning) {
  std::set<std::string_view> words;
  for (int k = 0; k <= static_cast<int>(HundredCarReason::no_scenario); ++k) {
    const auto reason = static_cast<HundredCarReason>(k);
    EXPECT_TRUE(words.insert(name(reason)).second) << name(reason);
    EXPECT_TRUE(words.insert(meaning(reason)).second) << meaning(reason);
  }
  EXPECT_EQ(name(HundredCarReason::unreadable), "unreadable");
  EXPECT_EQ(name(HundredCarReason::leaves_road), "leaves_road");
  EXPECT_EQ(name(HundredCarReason::no_scenario), "no_scenario");
}

TEST(ImpossibleValue, IsNamedAndWhatIsMissingIsNone) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<recordings::HundredCarRow> rows{{.speed = nan, .yaw_rate = nan}, {.speed = 99.0}};
  EXPECT_EQ(impossible_value(rows), "");
  rows[1].front.push_back({.id = 1, .range = 20.0, .rate = -2000.0});
  EXPECT_THAT(impossible_value(rows), HasSubstr("2000"));
  rows[0].yaw_rate = -7.0;
  EXPECT_THAT(impossible_value(rows), HasSubstr("-7.00"));
  rows[0].speed = 1e300;
  EXPECT_THAT(impossible_value(rows), HasSubstr("1e+300"));
}

/// Along the lane at 10 m/s.
scenario::Scenario scenario_on(double curvature, double seconds) {
  scenario::Scenario scenario;
  scenario.name = "x";
  scenario.title = scenario.source = scenario.licence = scenario.car = "x";
  scenario.duration = seconds;
  scenario.road.curvature = curvature;
  scenario::Recording recording;
  for (int k = 0; k <= static_cast<int>(10.0 * seconds); ++k) {
    recording.push_back({0.1 * k, from_lane(scenario.road, {1.0 * k, 0.0, 0.0}), 10.0, 0.0});
  }
  scenario.ego = recording;
  return scenario;
}

// A lane of 50 m radius has turned all the way round after 314 m.
TEST(ScenarioProblem, IsALaneThatTurnsTooFarOrWhatAFileMayNotHold) {
  EXPECT_EQ(scenario_problem(scenario_on(0.0, 30.0)), "");
  EXPECT_EQ(scenario_problem(scenario_on(0.002, 30.0)), "");
  EXPECT_THAT(scenario_problem(scenario_on(0.02, 30.0)), HasSubstr("turns by less than"));
  scenario::Scenario slippery = scenario_on(0.0, 30.0);
  slippery.grip = 0.0;
  EXPECT_THAT(scenario_problem(slippery), HasSubstr("grip"));
}

TEST(Contradiction, IsADepartureWhateverTheStudyCallsIt) {
  scenario::Scenario scenario = scenario_on(0.0, 5.0);
  scenario.road.right_edge = -0.5;
  for (const char* severity : {"Crash", "Near-Crash"}) {
    const auto wrong = contradiction(scenario, {.severity = severity}, {.event = 5});
    ASSERT_TRUE(wrong.has_value());
    EXPECT_EQ(wrong->refusal.reason, HundredCarReason::leaves_road);
    EXPECT_THAT(wrong->refusal.message, HasSubstr("event 5: want a driver who stays on the road"));
    ASSERT_TRUE(wrong->departure.has_value());
    EXPECT_EQ(wrong->departure->side, collision::Side::right);
  }
}

TEST(Contradiction, IsACrashWithoutATouch) {
  const scenario::Scenario scenario = scenario_on(0.0, 5.0);
  EXPECT_FALSE(contradiction(scenario, {.severity = "Near-Crash"}, {}));
  const auto wrong = contradiction(scenario, {.severity = "Crash"}, {});
  ASSERT_TRUE(wrong.has_value());
  EXPECT_EQ(wrong->refusal.reason, HundredCarReason::touches_nobody_in_crash);
  EXPECT_FALSE(wrong->departure.has_value());
}

}  // namespace
}  // namespace saca::importers::hundred_car_judge_test

#include "saca/lab/importers/recorded_drive.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"

namespace saca::importers::recorded_drive_test {
namespace {

/// Along x at 10 m/s for 4 s, then at rest for 1 s; drifts aside at `aside` m/s.
scenario::Recording drive_of(double aside) {
  scenario::Recording recording;
  for (int k = 0; k <= 50; ++k) {
    const double time = 0.1 * k;
    const double driven = std::min(time, 4.0);
    recording.push_back(
        {time, {{10.0 * driven, aside * driven}, 0.0}, time < 4.0 ? 10.0 : 0.0, 0.0});
  }
  return recording;
}

scenario::Scenario scenario_of(double aside) {
  scenario::Scenario scenario;
  scenario.road.lane_width = 3.66;
  scenario.road.left_edge = 1.83;
  scenario.road.right_edge = -1.83;
  scenario.ego = drive_of(aside);
  scenario.duration = 10.0;
  return scenario;
}

/// Stands with its rear at 30 m, seen from `first` to `last`.
scenario::ScenarioActor standing(double first, double last) {
  return {.footprint = {world::Shape::box, 4.8, 1.8, 0.0},
          .mass = 1500.0,
          .motion = scenario::Recording{{first, {{32.4, 0.0}, 0.0}, 0.0, 0.0},
                                        {last, {{32.4, 0.0}, 0.0}, 0.0, 0.0}}};
}

// Its front, 2.25 m ahead of the centre of mass, is at 30 m after 2.775 s.
TEST(RecordedDrive, FindsTheFirstTouch) {
  scenario::Scenario scenario = scenario_of(0.0);
  EXPECT_FALSE(recorded_drive(scenario, scenario::standard_ego).touch);
  scenario.actors.push_back(standing(0.0, 5.0));
  const RecordedDrive drive = recorded_drive(scenario, scenario::standard_ego);
  ASSERT_TRUE(drive.touch.has_value());
  EXPECT_NEAR(drive.touch->time, 2.775, 0.02);
  EXPECT_EQ(drive.touch->actor, 0U);
  EXPECT_FALSE(drive.departure);
}

TEST(RecordedDrive, LooksAtNobodyBeyondItsRecording) {
  for (const auto& [first, last] : {std::pair{0.0, 2.7}, std::pair{3.0, 5.0}}) {
    scenario::Scenario scenario = scenario_of(0.0);
    scenario.actors.push_back(standing(first, last));
    EXPECT_EQ(recorded_drive(scenario, scenario::standard_ego).touch.has_value(), first > 0.0);
  }
  scenario::Scenario scenario = scenario_of(0.0);
  scenario.actors.push_back(standing(0.0, 5.0));
  scenario.actors[0].ghost = true;
  EXPECT_FALSE(recorded_drive(scenario, scenario::standard_ego).touch);
}

// The side of its body, 0.95 m aside, is at the edge 0.88 m later: at 1 m/s after 0.88 s. In the
// end it is 4 m aside, 4 + 0.95 - 1.83 m beyond.
TEST(RecordedDrive, FindsWhenAndHowFarTheRoadIsLeft) {
  for (const double side : {1.0, -1.0}) {
    const RecordedDrive drive = recorded_drive(scenario_of(side), scenario::standard_ego);
    ASSERT_TRUE(drive.departure.has_value());
    EXPECT_EQ(drive.departure->side, side > 0.0 ? collision::Side::left : collision::Side::right);
    EXPECT_NEAR(drive.departure->time, 0.88, 0.021);
    EXPECT_NEAR(drive.departure->beyond, 3.12, 1e-6);
  }
}

TEST(RecordedDrive, LooksAtNothingAfterATouch) {
  scenario::Scenario scenario =
      scenario_of(0.2);  // beyond the edge only after 4.4 s, which it never is
  scenario.road.right_edge = -10.0;
  scenario.road.left_edge = 1.6;  // after 0.65 m, 3.25 s
  EXPECT_TRUE(recorded_drive(scenario, scenario::standard_ego).departure);
  scenario.actors.push_back(standing(0.0, 5.0));
  EXPECT_FALSE(recorded_drive(scenario, scenario::standard_ego).departure);
}

TEST(RecordedDrive, WantsARecording) {
  scenario::Scenario scenario = scenario_of(0.0);
  scenario.ego = scenario::EgoStart{};
  EXPECT_THROW((void)recorded_drive(scenario, scenario::standard_ego), ContractViolation);
  scenario.ego = scenario::Recording{{}};
  EXPECT_THROW((void)recorded_drive(scenario, scenario::standard_ego), ContractViolation);
}

}  // namespace
}  // namespace saca::importers::recorded_drive_test

#include "saca/lab/reach_study/scenario_obstacles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace saca::reach_study::scenario_obstacles_test {
namespace {

constexpr world::Footprint body{.length = 4.0, .width = 1.8};

scenario::Scenario with(const std::vector<scenario::ScenarioActor>& actors) {
  scenario::Scenario scenario;
  scenario.duration = 3.0;
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 10.0};
  scenario.actors = actors;
  return scenario;
}

double top_speed(const std::vector<danger::ObstacleKind>& all) {
  double top = 0.0;
  for (const danger::ObstacleKind& one : all) {
    top = std::max(top, one.top_speed);
  }
  return top;
}

TEST(ScenarioObstacles, HaveTheSpeedsThatTheyComeTo) {
  // From 5 m/s at 2 m/s^2 for 3 s: looked at each tenth step, 11 m/s but for one of them.
  const auto found =
      obstacles_of(with({{.id = 1,
                          .footprint = body,
                          .mass = 1'500.0,
                          .motion = scenario::Script{.start = {.s = 60.0},
                                                     .speed = 5.0,
                                                     .behaviour = scenario::Behaviour::accelerate,
                                                     .acceleration = 2.0}}}),
                   scenario::standard_ego);
  EXPECT_NEAR(top_speed(found), 11.0, 0.25);
  EXPECT_NEAR(found.front().top_speed, 5.0, 0.02);
  EXPECT_EQ(found.front().obstacle.length, 4.0);
}

TEST(ScenarioObstacles, AreGhostsToo) {
  scenario::ScenarioActor ghost{
      .id = 1,
      .footprint = {.length = 0.5, .width = 0.6},
      .mass = 80.0,
      .motion = scenario::Script{.start = {.s = 40.0}, .behaviour = scenario::Behaviour::hold},
      .ghost = true,
      .existence = 0.4};
  const auto found = obstacles_of(with({ghost}), scenario::standard_ego);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().obstacle.width, 0.6);
  EXPECT_EQ(top_speed(found), 0.0);
}

TEST(ScenarioObstacles, AreNoneWhereNobodyIs) {
  EXPECT_THAT(obstacles_of(with({}), scenario::standard_ego), testing::IsEmpty());
}

}  // namespace
}  // namespace saca::reach_study::scenario_obstacles_test

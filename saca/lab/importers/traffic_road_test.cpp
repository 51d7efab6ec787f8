#include "saca/lab/importers/traffic_road.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::importers::traffic_road_test {
namespace {

/// A lane to the east, 3.5 m wide, an ego in its middle, and one car at (x, y).
scenario::Scenario with_car(double x, double y, double yaw = 0.0) {
  scenario::Scenario scenario;
  scenario.ego = scenario::EgoStart{{0.0, 0.0, 0.0}, 10.0};
  const Pose X_WA{{x, y}, yaw};
  scenario.actors.push_back(
      {.kind = world::ActorKind::car,
       .footprint = {world::Shape::box, 4.5, 1.8, 0.0},
       .mass = 1500.0,
       .motion = scenario::Recording{{0.0, X_WA, 0.0, 0.0}, {1.0, X_WA, 0.0, 0.0}}});
  return scenario;
}

TEST(MovedRoad, IsTheSameRoadElsewhere) {
  world::Road road;
  road.X_WL = {{4e6 + 0.1234, 10.0}, 0.5};
  road.curvature = 0.01;
  const world::Road moved = moved_road(road, {-4e6, 5.0});
  const Vec2 here = from_lane(moved, {50.0, 1.0, 0.0}).p;
  const Vec2 there = from_lane(road, {50.0, 1.0, 0.0}).p;
  // Half a digit each: 0.5 mm, and 0.005 degrees over 50 m.
  EXPECT_NEAR(here.x, there.x - 4e6, 0.006);
  EXPECT_NEAR(here.y, there.y + 5.0, 0.006);
  EXPECT_EQ(moved.X_WL.p.x, 0.123);
}

TEST(WidenedRoad, HoldsWhoIsRecordedOnTheRoad) {
  const world::Road road = widened_road(with_car(10.0, 1.2), 20.0, 60.0);
  EXPECT_NEAR(road.left_edge, 1.2 + 0.9 + 0.2, 1e-9);
  EXPECT_EQ(road.right_edge, -1.75);
  EXPECT_NEAR(widened_road(with_car(10.0, -1.2), 20.0, 60.0).right_edge, -2.3, 1e-9);
  // A turned box reaches farther: half of 4.5 sin + 1.8 cos.
  EXPECT_NEAR(widened_road(with_car(10.0, 1.2, 0.3), 20.0, 60.0).left_edge,
              1.2 + 2.25 * std::sin(0.3) + 0.9 * std::cos(0.3) + 0.2, 5e-4);
}

TEST(WidenedRoad, DoesNotCountWhoIsElsewhere) {
  for (const Vec2 p : {Vec2{10.0, 1.8}, Vec2{70.0, 1.2}, Vec2{-30.0, 1.2}, Vec2{10.0, -0.2}}) {
    const world::Road road = widened_road(with_car(p.x, p.y), 20.0, 60.0);
    EXPECT_EQ(road.left_edge, 1.75);
    EXPECT_EQ(road.right_edge, -1.75);
  }
  scenario::Scenario scenario = with_car(10.0, 1.2);
  scenario.actors[0].kind = world::ActorKind::pedestrian;
  EXPECT_EQ(widened_road(scenario, 20.0, 60.0).left_edge, 1.75);
}

TEST(WidenedRoad, HoldsTheEgo) {
  scenario::Scenario scenario = with_car(10.0, 0.0);
  scenario.ego = scenario::EgoStart{{0.0, 1.0, 0.0}, 10.0};
  EXPECT_NEAR(widened_road(scenario, 20.0, 60.0).left_edge, 1.0 + 0.95 + 0.2, 1e-9);
  scenario.ego = scenario::Recording{{0.0, {{0.0, 0.0}, 0.0}, 10.0, 0.0},
                                     {1.0, {{10.0, -1.5}, 0.0}, 10.0, 0.0}};
  EXPECT_NEAR(widened_road(scenario, 20.0, 60.0).right_edge, -1.5 - 0.95 - 0.2, 1e-9);
}

TEST(WidenedRoad, WantsRecordings) {
  scenario::Scenario scenario = with_car(10.0, 0.0);
  scenario.actors[0].motion = scenario::Script{};
  EXPECT_THROW((void)widened_road(scenario, 20.0, 60.0), ContractViolation);
}

}  // namespace
}  // namespace saca::importers::traffic_road_test

#include "saca/thinking/intent/observed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::intent::observed_test {
namespace {

using world::Actor;
using world::Scene;

/// Three lanes of 3.5 m, the ego in the middle one; turned by `yaw` as a whole.
struct World {
  Scene scene;
  double yaw;

  explicit World(double turned = 0.0) : yaw(turned) {
    scene.ego.v_B = {20.0, 0.0};
    scene.ego.X_WB = {{0.0, 0.0}, yaw};
    scene.ego_footprint = {.length = 4.0, .width = 1.8};
    scene.ego_mass = 1'500.0;
    scene.road.X_WL = {{0.0, 0.0}, yaw};
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -5.25;
  }
  std::size_t add(Vec2 place, double heading, Vec2 velocity) {
    Actor actor{.footprint = {.length = 5.0, .width = 2.0}, .mass = 1'500.0};
    actor.id = static_cast<std::uint8_t>(scene.actors.size() + 1);
    actor.X_WA = {rotated(place, yaw), wrap_angle(heading + yaw)};
    actor.v_W = rotated(velocity, yaw);
    scene.actors.push_back(actor);
    return scene.actors.size() - 1;
  }
};

TEST(Observed, TellsPlaceAndMotionInTheLane) {
  for (const double yaw : {0.0, 0.5 * std::numbers::pi, 3.0}) {
    World world(yaw);
    const std::size_t i = world.add({30.0, 3.9}, 0.05, {15.0, 0.6});
    world.scene.actors[i].a_W = rotated({-3.0, 0.0}, yaw);
    world.scene.actors[i].yaw_rate = 0.02;
    const Observation seen = observed(world.scene, i);
    EXPECT_NEAR(seen.speed, std::hypot(15.0, 0.6), 1e-12);
    EXPECT_NEAR(seen.acceleration, -3.0 * 15.0 / std::hypot(15.0, 0.6), 1e-12);
    EXPECT_EQ(seen.yaw_rate, 0.02);
    EXPECT_NEAR(seen.offset, 0.4, 1e-9);
    EXPECT_NEAR(seen.lateral_speed, 0.6, 1e-9);
    EXPECT_NEAR(seen.heading, 0.05, 1e-9);
    EXPECT_EQ(seen.lane_width, 3.5);
    EXPECT_EQ(seen.gap, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(seen.brake));
  }
}

TEST(Observed, InTheMirrorLeftIsRight) {
  World here;
  World there;
  here.add({30.0, 0.7}, 0.05, {15.0, 0.6});
  there.add({30.0, -0.7}, -0.05, {15.0, -0.6});
  const Observation a = observed(here.scene, 0);
  const Observation b = observed(there.scene, 0);
  EXPECT_NEAR(a.offset, -b.offset, 1e-12);
  EXPECT_NEAR(a.lateral_speed, -b.lateral_speed, 1e-12);
  EXPECT_NEAR(a.heading, -b.heading, 1e-12);
}

TEST(Observed, OncomingTrafficHasItsOwnLeft) {
  World world;
  const std::size_t i =
      world.add({60.0, 3.9}, std::numbers::pi - 0.05, {-15.0, 0.75});  // to its right
  const Observation seen = observed(world.scene, i);
  EXPECT_NEAR(seen.offset, -0.4, 1e-9);
  EXPECT_NEAR(seen.lateral_speed, -0.75, 1e-9);
  EXPECT_NEAR(seen.heading, -0.05, 1e-9);
}

TEST(Observed, TheOneAheadIsTheNearestInItsLane) {
  World world;
  const std::size_t i = world.add({20.0, 0.0}, 0.0, {20.0, 0.0});
  world.add({80.0, 0.2}, 0.0, {10.0, 0.0});
  world.add({50.0, -0.3}, 0.0, {15.0, 0.0});
  world.add({30.0, 3.5}, 0.0, {5.0, 0.0});  // in the next lane
  const Observation seen = observed(world.scene, i);
  EXPECT_NEAR(seen.gap, 25.0, 1e-9);  // 30 m less two half lengths
  EXPECT_NEAR(seen.gap_speed, -5.0, 1e-9);
}

TEST(Observed, TheEgoCanBeAhead) {
  World world;
  const std::size_t i = world.add({-30.0, 0.0}, 0.0, {25.0, 0.0});
  const Observation seen = observed(world.scene, i);
  EXPECT_NEAR(seen.gap, 30.0 - 2.5 - 2.0, 1e-9);
  EXPECT_NEAR(seen.gap_speed, -5.0, 1e-9);
  const std::size_t oncoming = world.add({50.0, 0.0}, std::numbers::pi, {-10.0, 0.0});
  const Observation against = observed(world.scene, oncoming);
  EXPECT_NEAR(against.gap, 50.0 - 2.5 - 2.0, 1e-9);
  EXPECT_NEAR(against.gap_speed, -30.0, 1e-9);
}

TEST(Observed, BeyondAHundredMetresNobodyIsAhead) {
  World world;
  const std::size_t i = world.add({20.0, 0.0}, 0.0, {20.0, 0.0});
  world.add({130.0, 0.0}, 0.0, {10.0, 0.0});
  EXPECT_EQ(observed(world.scene, i).gap, std::numeric_limits<double>::infinity());
}

TEST(Observed, WhoCrossesOrIsOffTheRoadIsOnNoLane) {
  World world;
  const std::size_t crossing = world.add({30.0, -2.0}, 0.5 * std::numbers::pi, {0.0, 10.0});
  const std::size_t off = world.add({30.0, 9.0}, 0.0, {10.0, 0.0});
  for (const std::size_t i : {crossing, off}) {
    const Observation seen = observed(world.scene, i);
    EXPECT_TRUE(std::isnan(seen.offset));
    EXPECT_TRUE(std::isnan(seen.gap));
  }
  EXPECT_TRUE(std::isnan(observed(world.scene, crossing).lane_width));
}

TEST(Observed, ControlsAreKnownOfThoseWhoShareThem) {
  World world;
  const std::size_t silent = world.add({30.0, 0.0}, 0.0, {15.0, 0.0});
  const std::size_t open = world.add({60.0, 0.0}, 0.0, {15.0, 0.0});
  world.scene.actors[open].shared = {.steering = -0.1, .brake = 0.4};
  EXPECT_TRUE(std::isnan(observed(world.scene, silent).steering));
  EXPECT_TRUE(std::isnan(observed(world.scene, silent).brake));
  const Observation seen = observed(world.scene, open);
  EXPECT_EQ(seen.steering, -0.1);
  EXPECT_TRUE(std::isnan(seen.throttle));
  EXPECT_EQ(seen.brake, 0.4);
}

TEST(Observed, WhoStandsHasNoAcceleration) {
  World world;
  const std::size_t i = world.add({30.0, 0.0}, 0.0, {0.0, 0.0});
  const Observation seen = observed(world.scene, i);
  EXPECT_EQ(seen.speed, 0.0);
  EXPECT_EQ(seen.acceleration, 0.0);
  EXPECT_NEAR(seen.offset, 0.0, 1e-12);
  EXPECT_THROW((void)observed(world.scene, 1), ContractViolation);
}

}  // namespace
}  // namespace saca::intent::observed_test

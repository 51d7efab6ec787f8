#include "saca/lab/eval/lane_view.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/support/scenes.h"

namespace saca::eval::lane_view_test {
namespace {

/// 20 m/s; the ego's body is 4.7 x 1.9 m about its centre of mass.
world::Scene seen(world::Actor actor) {
  world::Scene scene = test::ego_at(20.0);
  scene.actors.push_back(actor);
  return scene;
}

TEST(LaneView, GapsAreFromBumperToBumperAndFromSideToSide) {
  const world::Scene scene = seen(test::car(1, {30.0, 3.5}, {15.0, -0.5}));
  const LaneView view = lane_view(scene, scene.actors[0]);
  // The car points where it goes, 1.9 degrees to the right: its box is a little wider and longer.
  const double turned = std::atan2(0.5, 15.0);
  EXPECT_NEAR(view.gap, 30.0 - 2.35 - (2.25 * std::cos(turned) + 0.9 * std::sin(turned)), 1e-9);
  EXPECT_NEAR(view.side_gap, 3.5 - 0.95 - (2.25 * std::sin(turned) + 0.9 * std::cos(turned)), 1e-9);
  EXPECT_NEAR(view.speed, 15.0, 1e-9);
  EXPECT_NEAR(view.closing_aside, 0.5, 1e-9);
  EXPECT_NEAR(view.ego_speed, 20.0, 1e-12);
  EXPECT_TRUE(view.ahead);
  EXPECT_TRUE(view.left);
  EXPECT_EQ(time_to_collision(view), std::nullopt);  // their paths do not overlap
}

TEST(LaneView, IsTheSameMirrored) {
  const world::Scene left = seen(test::car(1, {30.0, 3.5}, {15.0, -0.5}));
  const world::Scene right = seen(test::car(1, {30.0, -3.5}, {15.0, 0.5}));
  const LaneView a = lane_view(left, left.actors[0]);
  const LaneView b = lane_view(right, right.actors[0]);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.side_gap, b.side_gap);
  EXPECT_EQ(a.closing_aside, b.closing_aside);
  EXPECT_NE(a.left, b.left);
}

TEST(LaneView, WhoCrossesIsWideAndComesAside) {
  const world::Scene scene = seen(test::car(1, {30.0, 10.0}, {0.0, -8.0}));
  const LaneView view = lane_view(scene, scene.actors[0]);
  EXPECT_NEAR(view.side_gap, 10.0 - 0.95 - 2.25, 1e-9);
  EXPECT_NEAR(view.gap, 30.0 - 2.35 - 0.9, 1e-9);
  EXPECT_NEAR(view.closing_aside, 8.0, 1e-9);
  EXPECT_NEAR(view.speed, 0.0, 1e-9);
}

TEST(LaneView, TimeToCollisionIsGapOverClosingSpeed) {
  const world::Scene scene = seen(test::car(1, {24.6, 0.0}, {10.0, 0.0}));  // 20 m, 10 m/s
  EXPECT_NEAR(time_to_collision(lane_view(scene, scene.actors[0])).value(), 2.0, 1e-9);
  const world::Scene faster = seen(test::car(1, {24.6, 0.0}, {21.0, 0.0}));
  EXPECT_EQ(time_to_collision(lane_view(faster, faster.actors[0])), std::nullopt);
  const world::Scene behind = seen(test::car(1, {-24.6, 0.0}, {10.0, 0.0}));
  EXPECT_EQ(time_to_collision(lane_view(behind, behind.actors[0])), std::nullopt);
  const world::Scene oncoming = seen(test::car(1, {62.35 + 2.25, 0.0}, {-10.0, 0.0}));
  EXPECT_NEAR(time_to_collision(lane_view(oncoming, oncoming.actors[0])).value(), 2.0, 0.01);
}

}  // namespace
}  // namespace saca::eval::lane_view_test

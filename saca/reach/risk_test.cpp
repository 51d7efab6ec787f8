#include "saca/reach/risk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace saca::reach {
namespace {

using world::Actor;
using world::Scene;

/// Ego 4 m x 2 m in the middle of a road of one lane, so that only braking helps.
Scene narrow_road(double speed) {
  Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.ego_footprint = {.length = 4.0, .width = 2.0};
  scene.ego_mass = 1'700.0;
  scene.grip = 0.9;
  return scene;
}

Actor car(Vec2 p_W, Vec2 v_W) {
  Actor actor{.id = 1, .footprint = {.length = 4.0, .width = 2.0}, .mass = 1'500.0};
  actor.X_WA = {p_W, norm(v_W) > 0.0 ? std::atan2(v_W.y, v_W.x) : 0.0};
  actor.v_W = v_W;
  return actor;
}

// By hand: 15^2 / (2 * 0.9 * 9.81) + 15 * 0.10 = 14.24 m; 26 m are there.
TEST(ObstacleRisk, IsTheStoppingWayOverTheGap) {
  const ObstacleRisk risk = obstacle_risk(narrow_road(15.0), car({30.0, 0.0}, {}));
  EXPECT_NEAR(risk.room_needed.value(), 14.242, 0.001);
  EXPECT_NEAR(risk.room_there, 26.0, 0.16);  // the conflict is found to 10 ms
  EXPECT_NEAR(risk.risk, 14.242 / 26.0, 0.005);
  EXPECT_FALSE(risk.swerve_is_better);
}

TEST(ObstacleRisk, IsOneWhenNothingHelps) {
  EXPECT_EQ(obstacle_risk(narrow_road(15.0), car({14.0, 0.0}, {})).risk, 1.0);
  EXPECT_EQ(obstacle_risk(narrow_road(15.0), car({3.0, 0.0}, {})).risk, 1.0);  // touching
}

TEST(ObstacleRisk, IsZeroWithoutAConflict) {
  const ObstacleRisk risk = obstacle_risk(narrow_road(15.0), car({30.0, 4.0}, {}));
  EXPECT_EQ(risk.risk, 0.0);
  EXPECT_EQ(risk.room_needed, std::nullopt);
}

// Half a metre in the way: swerving 0.5 m takes sqrt(1 / 7.06) + 0.12 s, far less than stopping.
TEST(ObstacleRisk, SwervingHelpsWhereThereIsRoom) {
  Scene scene = narrow_road(20.0);
  scene.road.left_edge = 6.0;
  const Actor edge = car({40.0, -1.5}, {});
  const ObstacleRisk risk = obstacle_risk(scene, edge);
  EXPECT_TRUE(risk.swerve_is_better);
  EXPECT_NEAR(risk.room_needed.value(), 20.0 * (std::sqrt(1.0 / (0.72 * 9.81)) + 0.12), 0.01);
  scene.road.left_edge = 1.4;  // the ego's 2 m no longer fit beside it
  EXPECT_FALSE(obstacle_risk(scene, edge).swerve_is_better);
  EXPECT_LT(risk.risk, obstacle_risk(scene, edge).risk);
}

// A truck that will stand across both lanes leaves nothing to swerve to, though it is still beside
// the road now.
TEST(ObstacleRisk, ACrossingTruckIsJudgedWhereItWillBe) {
  Scene scene = narrow_road(14.0);
  scene.road.left_edge = 5.25;
  scene.road.right_edge = -5.25;
  Actor truck = car({30.0, 16.0}, {0.0, -8.0});
  truck.footprint = {.length = 8.0, .width = 2.5};
  const ObstacleRisk risk = obstacle_risk(scene, truck);
  EXPECT_FALSE(risk.swerve_is_better);
  EXPECT_GT(risk.risk, 0.4);  // 12.5 m to stop, less than 27 m there
}

TEST(ObstacleRisk, GrowsWithSpeedAndWithIce) {
  const Actor wreck = car({60.0, 0.0}, {});
  EXPECT_LT(obstacle_risk(narrow_road(15.0), wreck).risk,
            obstacle_risk(narrow_road(20.0), wreck).risk);
  Scene icy = narrow_road(15.0);
  icy.grip = 0.3;
  EXPECT_LT(obstacle_risk(narrow_road(15.0), wreck).risk, obstacle_risk(icy, wreck).risk);
}

TEST(ObstacleRisk, ALeadThatBrakesIsWorseThanOneThatDrivesOn) {
  const Actor steady = car({34.0, 0.0}, {12.0, 0.0});
  Actor braking = steady;
  braking.a_W = {-6.0, 0.0};
  const Scene scene = narrow_road(18.0);
  EXPECT_LT(obstacle_risk(scene, steady).risk, obstacle_risk(scene, braking).risk);
  EXPECT_NEAR(obstacle_risk(scene, braking).room_there, 30.0, 0.2);  // the gap now
}

// Both at 20 m/s, 15 m apart, grip 0.5, the lead brakes at 7 m/s^2: closing only begins, but
// swerving 2 m takes t = sqrt(4 / 3.92) + 0.12 s, in which the lead falls back 3.5 t^2.
TEST(ObstacleRisk, ALeadThatBrakesFromTheEgosOwnSpeedIsAThreat) {
  Scene scene = narrow_road(20.0);
  scene.grip = 0.5;
  scene.road.left_edge = 5.25;
  Actor lead = car({19.0, 0.0}, {20.0, 0.0});
  lead.a_W = {-7.0, 0.0};
  const ObstacleRisk risk = obstacle_risk(scene, lead);
  const double t = std::sqrt(4.0 / (0.4 * 9.81)) + 0.12;
  EXPECT_TRUE(risk.swerve_is_better);  // braking: 40.8 + 2 - 28.6 = 14.2 m
  EXPECT_NEAR(risk.room_needed.value(), 3.5 * t * t, 0.01);
}

TEST(ObstacleRisk, AFollowerIsNone) {
  EXPECT_EQ(obstacle_risk(narrow_road(15.0), car({-20.0, 0.0}, {19.0, 0.0})).risk, 0.0);
}

TEST(ObstacleRisk, IsTheSameMirroredAndTurned) {
  Scene scene = narrow_road(18.0);
  scene.road.left_edge = 5.0;
  Actor actor = car({35.0, -1.0}, {2.0, 0.3});
  const double risk = obstacle_risk(scene, actor).risk;

  Scene mirrored = scene;
  mirrored.road.left_edge = 1.75;
  mirrored.road.right_edge = -5.0;
  Actor there = actor;
  there.X_WA = {{35.0, 1.0}, -actor.X_WA.yaw};
  there.v_W.y = -0.3;
  EXPECT_NEAR(obstacle_risk(mirrored, there).risk, risk, 1e-9);

  const Pose X_VW{{5.0, 9.0}, std::numbers::pi / 2.0};
  scene.ego.X_WB = X_VW * scene.ego.X_WB;
  scene.road.X_WL = X_VW * scene.road.X_WL;
  actor.X_WA = X_VW * actor.X_WA;
  actor.v_W = rotated(actor.v_W, X_VW.yaw);
  EXPECT_NEAR(obstacle_risk(scene, actor).risk, risk, 0.01);  // 10 ms of the conflict
}

TEST(Explanation, SaysWhatIsNeededAndWhatIsThere) {
  EXPECT_THAT(explanation(obstacle_risk(narrow_road(15.0), car({30.0, 0.0}, {}))),
              testing::HasSubstr("braking needs 14.2 m of the 2"));
  EXPECT_THAT(explanation({}), testing::HasSubstr("no conflict"));
}

}  // namespace
}  // namespace saca::reach

#include "saca/thinking/danger/risk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/support/scenes.h"

namespace saca::danger::risk_test {
namespace {

using test::ego_at;
using test::whole_metres;
using world::Actor;
using world::ActorKind;
using world::Scene;

constexpr double pi = std::numbers::pi;

// Without tables: the best of a few evasions, in closed form where braking is best.
const DangerModel& model() {
  static const DangerModel few({}, {.length = 4.0, .width = 2.0}, {});
  return few;
}

/// It points along x_W, wherever it goes, or as is said.
Actor car(Vec2 p_W, Vec2 v_W, double yaw = 0.0) {
  Actor actor = test::block(1, p_W, v_W);
  actor.X_WA.yaw = yaw;
  return actor;
}

/// A wall from far left to far right, before which only braking helps.
Actor wall(double x) {
  Actor actor = car({x, 0.0}, {});
  actor.kind = ActorKind::obstacle;
  actor.footprint = {.length = 1.0, .width = 400.0};
  return actor;
}

// By hand: 15^2 / (2 x 0.9 x 9.80665) = 12.74 m to stop, of 27.5 m between bumper and wall: 14.76 m
// are left, so R = (30 - 14.76) / 30.
TEST(ObstacleRisk, IsWhatBrakingLeavesWhereNothingElseHelps) {
  const ObstacleRisk risk = obstacle_risk(ego_at(15.0, whole_metres), wall(30.0), model());
  EXPECT_NEAR(risk.value, -(27.5 - 15.0 * 15.0 / (2.0 * 0.9 * 9.80665)), 1e-3);
  EXPECT_NEAR(risk.risk, (30.0 + risk.value) / 30.0, 1e-12);
}

TEST(ObstacleRisk, IsOneWhereNothingHelps) {
  EXPECT_EQ(obstacle_risk(ego_at(15.0, whole_metres), wall(14.0), model()).risk, 1.0);
  EXPECT_GE(obstacle_risk(ego_at(15.0, whole_metres), wall(14.0), model()).value, 0.0);
  EXPECT_EQ(obstacle_risk(ego_at(15.0, whole_metres), car({3.0, 0.0}, {}), model()).risk,
            1.0);  // touching
}

TEST(ObstacleRisk, IsZeroThirtyMetresAway) {
  const ObstacleRisk far =
      obstacle_risk(ego_at(5.0, whole_metres), car({0.0, 60.0}, {}, 0.5 * pi), model());
  EXPECT_EQ(far.risk, 0.0);
  EXPECT_NEAR(far.value, -57.0, 1e-3);  // half a width and half a length nearer than the middles
}

TEST(ObstacleRisk, AFollowerIsNotJudged) {
  const ObstacleRisk risk =
      obstacle_risk(ego_at(15.0, whole_metres), car({-9.0, 0.0}, {19.0, 0.0}), model());
  EXPECT_EQ(risk.risk, 0.0);
  EXPECT_FALSE(risk.judged);
  EXPECT_EQ(explanation(risk), "behind the ego: not judged");
}

TEST(ObstacleRisk, AnEgoThatDriftsIsADisc) {
  Scene scene = ego_at(10.0, whole_metres);
  scene.ego.X_WB.yaw = 0.5 * pi;  // broadside
  scene.ego.v_B = {0.0, -10.0};
  const Meeting broadside = meeting_of(scene, wall(30.0));
  EXPECT_NEAR(broadside.state[2], 0.0, 1e-12);
  EXPECT_NEAR(broadside.ego.length, 2.0 * std::hypot(2.0, 1.0), 1e-12);
  EXPECT_NEAR(broadside.ego.width, 2.0 * std::hypot(2.0, 1.0), 1e-12);
  EXPECT_EQ(broadside.ego.shape, world::Shape::ellipse);
  // A little sideslip, as in any bend, leaves the body as it is.
  scene.ego.v_B = {10.0, 0.5};
  EXPECT_EQ(meeting_of(scene, wall(30.0)).ego.length, 4.0);
}

TEST(ObstacleRisk, IsExactWhereATableHasItAndBothMoveAsItSays) {
  const Grid grid{
      {{.name = "x", .first = -50.0, .last = 50.0, .points = 4},
       {.name = "y", .first = -50.0, .last = 50.0, .points = 4},
       {.name = "course", .first = -pi, .last = pi, .points = 8, .edge = Edge::periodic},
       {.name = "speed", .first = 0.0, .last = 30.0, .points = 4}}};
  const std::vector<float> five_metres(num_cells(grid), -5.0F);
  const world::Footprint body{.length = 4.0, .width = 2.0};
  const DangerModel table(
      {}, body, {{body, 0.0, View::obstacle, std::make_shared<ValueTable>(grid, five_metres)}});
  Scene scene = ego_at(10.0, whole_metres);
  const Actor parked = car({20.0, 0.0}, {});
  EXPECT_TRUE(obstacle_risk(scene, parked, table).exact);
  EXPECT_FALSE(obstacle_risk(scene, car({60.0, 0.0}, {}), table).exact);
  EXPECT_FALSE(obstacle_risk(scene, car({20.0, 0.0}, {-8.0, 0.0}), table).exact);
  EXPECT_FALSE(obstacle_risk(scene, car({20.0, 0.0}, {0.0, 1.0}), table).exact);  // slides
  scene.ego.v_B = {10.0, 2.0};
  EXPECT_FALSE(obstacle_risk(scene, parked, table).exact);  // drifts
}

TEST(ObstacleRisk, GrowsWithSpeedAndWithIce) {
  EXPECT_LT(obstacle_risk(ego_at(12.0, whole_metres), wall(40.0), model()).risk,
            obstacle_risk(ego_at(16.0, whole_metres), wall(40.0), model()).risk);
  Scene icy = ego_at(12.0, whole_metres);
  icy.grip = 0.4;
  EXPECT_LT(obstacle_risk(ego_at(12.0, whole_metres), wall(40.0), model()).risk,
            obstacle_risk(icy, wall(40.0), model()).risk);
}

// A person is hit, for the risk, where a car would be missed by less than a metre.
TEST(ObstacleRisk, CountsForPeopleAMetreEarlier) {
  Actor person = wall(16.0);  // 0.76 m are left
  EXPECT_LT(obstacle_risk(ego_at(15.0, whole_metres), person, model()).risk, 1.0);
  person.kind = ActorKind::pedestrian;
  EXPECT_EQ(obstacle_risk(ego_at(15.0, whole_metres), person, model()).risk, 1.0);
}

TEST(ObstacleRisk, ALeadThatDrivesOnIsLessThanOneAtRest) {
  EXPECT_LT(obstacle_risk(ego_at(18.0, whole_metres), car({34.0, 0.0}, {12.0, 0.0}), model()).value,
            obstacle_risk(ego_at(18.0, whole_metres), car({34.0, 0.0}, {}), model()).value);
}

TEST(ObstacleRisk, IsTheSameMirroredAndTurned) {
  const Scene scene = ego_at(14.0, whole_metres);
  const Actor actor = car({25.0, -1.0}, {3.0, 0.2}, 0.1);
  const double value = obstacle_risk(scene, actor, model()).value;

  Actor mirrored = actor;
  mirrored.X_WA = {{25.0, 1.0}, -0.1};
  mirrored.v_W.y = -0.2;
  EXPECT_NEAR(obstacle_risk(scene, mirrored, model()).value, value, 1e-6);

  const Pose X_VW{{5.0, 9.0}, pi / 2.0};
  Scene turned = scene;
  turned.ego.X_WB = X_VW * scene.ego.X_WB;
  Actor there = actor;
  there.X_WA = X_VW * actor.X_WA;
  there.v_W = rotated(actor.v_W, X_VW.yaw);
  EXPECT_NEAR(obstacle_risk(turned, there, model()).value, value, 1e-6);
}

// Reversing is driving with the body turned round.
TEST(MeetingOf, TakesAnObstacleByTheWayItMoves) {
  const Meeting meeting = meeting_of(ego_at(10.0, whole_metres), car({20.0, 3.0}, {-5.0, 0.0}));
  EXPECT_NEAR(meeting.obstacle_speed, 5.0, 1e-12);
  EXPECT_NEAR(meeting.state[0], 20.0, 1e-9);  // the ego drives towards it, and it towards the ego
  EXPECT_NEAR(meeting.state[1], 3.0, 1e-9);
  EXPECT_NEAR(std::abs(meeting.state[2]), pi, 1e-9);
  EXPECT_EQ(meeting.state[3], 10.0);
}

TEST(MeetingOf, AnActorThatSlidesIsADiscOnItsWay) {
  const Actor sliding = car({20.0, 0.0}, {0.0, 3.0});
  const Meeting meeting = meeting_of(ego_at(10.0, whole_metres), sliding);
  EXPECT_NEAR(meeting.obstacle.length, 2.0 * std::hypot(2.0, 1.0), 1e-12);
  EXPECT_NEAR(meeting.state[2], -pi / 2.0, 1e-12);
  EXPECT_NEAR(meeting.state[1], 20.0, 1e-9);  // its x points to the left: the ego is to its left
  EXPECT_FALSE(obstacle_risk(ego_at(10.0, whole_metres), sliding, model()).exact);
}

TEST(MeetingOf, TheNoiseOfARestIsRest) {
  EXPECT_EQ(meeting_of(ego_at(10.0, whole_metres), car({20.0, 0.0}, {0.2, 0.1})).obstacle_speed,
            0.0);
  Scene creeping = ego_at(0.1, whole_metres);
  creeping.ego.v_B = {0.0, 0.1};
  EXPECT_EQ(meeting_of(creeping, car({20.0, 0.0}, {})).state[2], 0.0);
}

TEST(Explanation, SaysWhatTheBestEvasionLeaves) {
  EXPECT_EQ(explanation({.risk = 1.0, .value = 0.43, .exact = true}),
            "best evasion still hits 0.4 m deep");
  EXPECT_EQ(explanation({.risk = 0.9, .value = -1.18, .exact = true}),
            "best evasion misses by 1.2 m");
  EXPECT_EQ(explanation({.risk = 0.9, .value = -1.18, .exact = false}),
            "best evasion misses by at least 1.2 m");
  EXPECT_EQ(explanation({.risk = 1.0, .value = 0.43, .exact = false}),
            "best evasion still hits at most 0.4 m deep");
}

}  // namespace
}  // namespace saca::danger::risk_test

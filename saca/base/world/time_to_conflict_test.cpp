#include "saca/base/world/time_to_conflict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::world::time_to_conflict_test {
namespace {

using test::block;
using test::ego_at;
using test::whole_metres;

constexpr double pi = std::numbers::pi;
constexpr double exactness = 0.0101;  // 10 ms as stated, and rounding

Scene turned(Scene scene, Actor& actor, double angle) {
  const Pose X_VW{{30.0, -20.0}, angle};  // another world
  scene.ego.X_WB = X_VW * scene.ego.X_WB;
  scene.road.X_WL = X_VW * scene.road.X_WL;
  actor.X_WA = X_VW * actor.X_WA;
  actor.v_W = rotated(actor.v_W, angle);
  actor.a_W = rotated(actor.a_W, angle);
  return scene;
}

TEST(TimeToConflict, IsGapOverClosingSpeedInLine) {
  const Scene scene = ego_at(20.0, whole_metres);
  const Actor lead = block(1, {34.0, 0.0}, {5.0, 0.0});  // gap 30 m, closing at 15 m/s
  EXPECT_NEAR(time_to_conflict(scene, lead, 5.0, 0.0).value(), 2.0, exactness);
  EXPECT_EQ(time_to_conflict(scene, lead, 1.9, 0.0), std::nullopt);
}

TEST(TimeToConflict, KnowsABrakingLead) {
  Scene scene = ego_at(20.0, whole_metres);
  Actor lead = block(1, {24.0, 0.0}, {20.0, 0.0});  // same speed, gap 20 m
  EXPECT_EQ(time_to_conflict(scene, lead, 5.0, 0.0), std::nullopt);
  lead.a_W = {-5.0, 0.0};  // gap closes as 2.5 t^2 while it brakes (4 s): t = sqrt(8)
  EXPECT_NEAR(time_to_conflict(scene, lead, 5.0, 0.0).value(), std::sqrt(8.0), exactness);
}

TEST(TimeToConflict, ABrakingLeadStopsAndDoesNotReverse) {
  const Scene scene = ego_at(2.0, whole_metres);
  Actor lead = block(1, {24.0, 0.0}, {10.0, 0.0});
  lead.a_W = {-5.0, 0.0};  // stops after 10 m: 30 m of room at 2 m/s
  EXPECT_NEAR(time_to_conflict(scene, lead, 20.0, 0.0).value(), 15.0, exactness);
}

// The paper's truck passes behind the ego; with a tolerance their paths are in conflict.
TEST(TimeToConflict, ToleranceFindsCrossingTrafficThatWouldJustMiss) {
  const Scene scene = ego_at(10.0, whole_metres);
  // Crosses the ego's path x = 30 from the left: its front is at y = 1 (the ego's side) after 4.0
  // s, while the ego has left (x - 2 > 31) after 3.3 s.
  const Actor crossing = block(1, {30.0, 43.0}, {0.0, -10.0});
  EXPECT_EQ(time_to_conflict(scene, crossing, 8.0, 0.0), std::nullopt);
  // The ego is there from t = 2.7 (front at 29) to 3.3; the actor arrives at 4.0: |4.0 - t| <= 1.
  EXPECT_NEAR(time_to_conflict(scene, crossing, 8.0, 1.0).value(), 3.0, exactness);
  EXPECT_NEAR(time_to_conflict(scene, crossing, 8.0, 2.0).value(), 2.7, exactness);
}

TEST(TimeToConflict, ACarBesideIsNone) {
  EXPECT_EQ(
      time_to_conflict(ego_at(20.0, whole_metres), block(1, {10.0, 3.5}, {15.0, 0.0}), 10.0, 0.0),
      std::nullopt);
}

TEST(TimeToConflict, TouchingIsNow) {
  EXPECT_EQ(time_to_conflict(ego_at(5.0, whole_metres), block(1, {3.0, 0.0}, {}), 5.0, 0.0), 0.0);
}

TEST(TimeToConflict, AtRestNothingHappens) {
  EXPECT_EQ(time_to_conflict(ego_at(0.0, whole_metres), block(1, {30.0, 0.0}, {}), 5.0, 2.0),
            std::nullopt);
}

TEST(TimeToConflict, FollowsTheLane) {
  Scene scene = ego_at(10.0, whole_metres);
  scene.road.curvature = 0.02;  // radius 50 m to the left
  // A quarter of the circle is 78.5 m; an obstacle there, 4 m of half lengths before it.
  Actor obstacle = block(1, {50.0, 50.0}, {});
  obstacle.X_WA.yaw = pi / 2.0;
  EXPECT_NEAR(time_to_conflict(scene, obstacle, 10.0, 0.0).value(), (25.0 * pi - 4.0) / 10.0, 0.02);
  EXPECT_EQ(time_to_conflict(scene, block(1, {70.0, 0.0}, {}), 10.0, 0.0), std::nullopt);
}

TEST(TimeToConflict, IsTheSameInEveryWorldFrameAndMirrored) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = ego_at(15.0 + 5.0 * u(rng), whole_metres);
    const Actor actor =
        block(1, {40.0 + 20.0 * u(rng), 30.0 * u(rng)}, {8.0 * u(rng), 8.0 * u(rng)});
    const auto expected = time_to_conflict(scene, actor, 6.0, 0.5);
    Actor there = actor;
    const Scene other = turned(scene, there, pi / 2.0);
    EXPECT_NEAR(time_to_conflict(other, there, 6.0, 0.5).value_or(-1.0), expected.value_or(-1.0),
                exactness);
    Actor mirrored = actor;
    mirrored.X_WA = {{actor.X_WA.p.x, -actor.X_WA.p.y}, -actor.X_WA.yaw};
    mirrored.v_W.y = -actor.v_W.y;
    EXPECT_NEAR(time_to_conflict(scene, mirrored, 6.0, 0.5).value_or(-1.0), expected.value_or(-1.0),
                exactness);
  }
}

// Oracle: every pair of 10 ms instants; on bends, with actors that turn, brake and speed up.
TEST(TimeToConflict, AgreesWithLookingAtEveryInstant) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  constexpr double horizon = 3.0;
  int num_conflicts = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene = ego_at(15.0, whole_metres);
    scene.road.curvature = i % 3 == 0 ? 0.0 : 0.02 * u(rng);
    Actor actor = block(1, {25.0 + 10.0 * u(rng), 12.0 * u(rng)}, {8.0 * u(rng), 8.0 * u(rng)});
    if (i % 2 == 1) {
      actor.yaw_rate = 0.5 * u(rng);
      actor.a_W = 3.0 * u(rng) * actor.v_W;
      actor.X_WA.yaw += 0.2 * u(rng);
    }
    const double tolerance = i % 4 < 2 ? 0.0 : (i % 5 == 0 ? 1.5 : 0.3);
    double expected = -1.0;
    const int window =
        is_crossing(scene, actor) ? static_cast<int>(std::lround(tolerance / 0.01)) : 0;
    for (int k = 0; k <= 300 && expected < 0.0; ++k) {
      for (int j = std::max(0, k - window); j <= k + window; ++j) {
        const Pose X_WB = ego_going_on(scene, 0.01 * k);
        const Pose X_WA = actor_going_on(actor, 0.01 * j);
        if (separation(scene.ego_footprint, X_WB, actor.footprint, X_WA).distance <= 0.0) {
          expected = 0.01 * k;
          break;
        }
      }
    }
    num_conflicts += expected >= 0.0 ? 1 : 0;
    EXPECT_NEAR(time_to_conflict(scene, actor, horizon, tolerance).value_or(-1.0), expected, 0.0201)
        << "encounter " << i;
  }
  EXPECT_GT(num_conflicts, 60);
}

TEST(TimeToConflict, FindsAContactAtTheVeryHorizon) {
  const Scene scene = ego_at(20.0, whole_metres);
  const Actor lead = block(1, {34.0, 0.0}, {5.0, 0.0});  // gap 30 m, closing at 15 m/s
  EXPECT_NEAR(time_to_conflict(scene, lead, 2.0005, 0.0).value(), 2.0, exactness);
  EXPECT_EQ(time_to_conflict(scene, lead, 1.985, 0.0), std::nullopt);
}

// Within a short horizon and a wide tolerance the actor is looked for long after the horizon, when
// it has become much faster.
TEST(TimeToConflict, KnowsHowFastACrossingActorWillBe) {
  const Scene scene = ego_at(10.0, whole_metres);
  Actor actor = block(1, {0.0, -16.0}, {0.0, 2.0});
  actor.a_W = {0.0, 6.0};  // 13 m to the ego's ground: 2 t + 3 t^2, 1.775 s
  EXPECT_EQ(time_to_conflict(scene, actor, 0.1, 1.6), std::nullopt);
  EXPECT_NEAR(time_to_conflict(scene, actor, 0.1, 1.72).value(), 0.055, exactness);
}

TEST(TimeToConflict, ATrackAndItsOwnMotionAgree) {
  const Scene scene = ego_at(12.0, whole_metres);
  const Actor actor = block(1, {40.0, -16.0}, {0.0, 5.0});
  Track track{.start = scene.time, .step = 0.05, .X_WA = {}};
  for (int k = 0; k <= 120; ++k) {
    track.X_WA.push_back(actor_going_on(actor, 0.05 * k));
  }
  EXPECT_NEAR(time_to_conflict(scene, actor, track, 6.0, 0.5).value(),
              time_to_conflict(scene, actor, 6.0, 0.5).value(), exactness);
}

TEST(IsCrossing, LooksAtTheCourseAgainstTheLane) {
  const Scene scene = ego_at(10.0, whole_metres);
  EXPECT_TRUE(is_crossing(scene, block(1, {30.0, 10.0}, {0.0, -5.0})));
  EXPECT_FALSE(is_crossing(scene, block(1, {30.0, 0.0}, {5.0, 0.0})));
  EXPECT_FALSE(is_crossing(scene, block(1, {30.0, 0.0}, {-5.0, 0.0})));
  EXPECT_FALSE(is_crossing(scene, block(1, {30.0, 0.0}, {})));
}

TEST(IsFollower, IsWhollyBehindAndInTheEgosPath) {
  const Scene scene = ego_at(10.0, whole_metres);  // from x = -2 to 2, y = -1 to 1
  EXPECT_TRUE(is_follower(scene, block(1, {-6.0, 0.5}, {12.0, 0.0})));
  EXPECT_FALSE(is_follower(scene, block(1, {-3.0, 0.0}, {12.0, 0.0})));  // bodies overlap
  EXPECT_FALSE(is_follower(scene, block(1, {-6.0, 3.5}, {12.0, 0.0})));  // next lane
  EXPECT_TRUE(is_behind(scene, block(1, {-6.0, 3.5}, {12.0, 0.0})));
  EXPECT_FALSE(is_behind(scene, block(1, {-1.0, 3.5}, {12.0, 0.0})));  // beside
  EXPECT_FALSE(is_behind(scene, block(1, {-6.0, 9.0}, {0.0, -5.0})));  // crosses
}

TEST(TimeToConflict, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(
      (void)time_to_conflict(ego_at(5.0, whole_metres), block(1, {30.0, 0.0}, {}), 0.0, 0.0),
      ContractViolation);
  EXPECT_THROW((void)time_to_conflict(ego_at(5.0, whole_metres), block(1, {30.0, 0.0}, {}), 1.0,
                                      std::nan("")),
               ContractViolation);
  EXPECT_THROW(
      (void)time_to_collision(ego_at(5.0, whole_metres), block(1, {30.0, 0.0}, {}), Track{}, 1.0),
      ContractViolation);
}

// Where two flat faces have come within a rounding, the line between their nearest points says
// nothing of who closes on whom. A car that stands ahead is in conflict from wherever it is seen.
TEST(TimeToConflict, NoStandingCarIsLostOnTheWayToIt) {
  for (int k = 0; k < 1'000; ++k) {
    Scene scene = test::ego_at(20.0);
    scene.ego.X_WB.p.x = 0.013 * k;
    scene.actors.push_back(test::car(1, {2.35 + 30.0 + 2.25, 0.0}));
    for (const double horizon : {1.6, 5.5}) {
      const auto time = time_to_conflict(scene, scene.actors[0], horizon, 0.5);
      ASSERT_TRUE(time.has_value()) << k;
      EXPECT_NEAR(*time, (30.0 - 0.013 * k) / 20.0, 0.0101) << k;
    }
  }
}

constexpr EgoPrediction as_measured = EgoPrediction::as_measured;

// 4.5 m/s^2 are measured, and 0.5 of them do not count: 20 m/s are lost in 5 s and 50 m.
TEST(EgoGoingOn, AsMeasuredBrakesUntilItIsAtRest) {
  Scene scene = ego_at(20.0);
  scene.ego.a_B = {-4.5, 0.0};
  EXPECT_NEAR(ego_going_on(scene, 2.0, as_measured).p.x, 20.0 * 2.0 - 0.5 * 4.0 * 4.0, 1e-9);
  EXPECT_NEAR(ego_going_on(scene, 9.0, as_measured).p.x, 50.0, 1e-9);
  EXPECT_NEAR(ego_going_on(scene, 9.0).p.x, 180.0, 1e-9);
  scene.ego.a_B = {3.0, 0.0};
  EXPECT_NEAR(ego_going_on(scene, 2.0, as_measured).p.x, 40.0, 1e-9) << "it does not speed up";
}

// Oracle: small steps along the arc that is left of what is measured beyond the bands.
TEST(EgoGoingOn, AsMeasuredFollowsCourseAndYawRate) {
  Scene scene = ego_at(15.0);
  scene.ego.X_WB.yaw = 0.1;
  scene.ego.yaw_rate = 0.3;
  scene.ego.a_B = {-3.5, 15.0 * 0.3};
  double course = std::asin((15.0 * std::sin(0.1) - 0.5) / 15.0);
  const double curvature = (15.0 * 0.3 - 0.5) / (15.0 * 15.0);
  Vec2 p_W;
  double speed = 15.0;
  constexpr double dt = 1e-4;
  for (int k = 0; k < 15'000; ++k) {
    p_W = p_W + (speed * dt) * Vec2{std::cos(course), std::sin(course)};
    course += curvature * speed * dt;
    speed -= 3.0 * dt;
  }
  const Pose there = ego_going_on(scene, 1.5, as_measured);
  EXPECT_NEAR(there.p.x, p_W.x, 2e-3);  // of Euler's steps, O(dt)
  EXPECT_NEAR(there.p.y, p_W.y, 2e-3);
  EXPECT_NEAR(there.yaw, course, 1e-3);
}

TEST(EgoGoingOn, AsMeasuredIsInLaneWhileTheLaneIsKept) {
  std::mt19937 rng(8);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double speed = 15.0 + 10.0 * u(rng);
    Scene scene = ego_at(speed);
    scene.road.curvature = 0.01 * u(rng);
    scene.ego.X_WB =
        from_lane(scene.road,
                  {.s = 30.0 * u(rng), .d = u(rng), .heading = std::asin(0.499 * u(rng) / speed)});
    const double d = to_lane(scene.road, scene.ego.X_WB).d;
    scene.ego.yaw_rate =
        speed * scene.road.curvature / (1.0 - scene.road.curvature * d) + 0.499 * u(rng) / speed;
    scene.ego.a_B = {0.499 * u(rng), speed * scene.ego.yaw_rate};
    const Pose in_lane = ego_going_on(scene, 1.3);
    const Pose measured = ego_going_on(scene, 1.3, as_measured);
    EXPECT_NEAR(measured.p.x, in_lane.p.x, 1e-9) << i;
    EXPECT_NEAR(measured.p.y, in_lane.p.y, 1e-9) << i;
    EXPECT_NEAR(measured.yaw, in_lane.yaw, 1e-9) << i;
    // In its lane it keeps its offset from the middle, whatever the bend.
    const LanePose kept = to_lane(scene.road, in_lane);
    EXPECT_NEAR(kept.d, d, 1e-9) << i;
    EXPECT_NEAR(kept.heading, 0.0, 1e-9) << i;
  }
}

// Backwards at 2 m/s, away from a wall 1.5 m ahead; sideways, in a slide, is not backwards.
TEST(TimeToConflict, WhoRollsBackMeetsNobodyAhead) {
  Scene scene = ego_at(0.0, whole_metres);
  scene.ego.v_B = {-2.0, 0.0};
  const Actor wall = block(1, {5.5, 0.0});
  EXPECT_EQ(time_to_conflict(scene, wall, 5.0, 0.0), std::nullopt);
  scene.ego.v_B = {2.0, 0.0};
  EXPECT_NEAR(time_to_conflict(scene, wall, 5.0, 0.0).value(), 0.75, exactness);
  scene.ego.X_WB.yaw = 0.6 * pi;  // turned by 108 degrees, and sliding along the lane
  scene.ego.v_B = rotated({8.0, 0.0}, -scene.ego.X_WB.yaw);
  ASSERT_LT(scene.ego.v_B.x, 0.0);
  EXPECT_TRUE(time_to_conflict(scene, wall, 5.0, 0.0).has_value());
}

// At rest, crawling and backwards there is no course to be measured.
TEST(EgoGoingOn, IsInLaneWhereNoCourseIsMeasured) {
  for (const Vec2 v_B : {Vec2{0.0, 0.0}, Vec2{0.05, 0.0}, Vec2{-2.0, 0.0}}) {
    Scene scene = ego_at(0.0);
    scene.ego.v_B = v_B;
    scene.ego.yaw_rate = 0.4;
    scene.ego.a_B = {-5.0, 0.0};
    EXPECT_EQ(ego_going_on(scene, 2.0, as_measured).p.x, ego_going_on(scene, 2.0).p.x);
    EXPECT_EQ(ego_going_on(scene, 2.0, as_measured).p.y, ego_going_on(scene, 2.0).p.y);
  }
}

// Oracle: every 10 ms, the ego braking and turning.
TEST(TimeToConflict, AsMeasuredAgreesWithLookingAtEveryInstant) {
  std::mt19937 rng(9);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int num_conflicts = 0;
  int num_different = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene = ego_at(15.0, whole_metres);
    scene.road.curvature = i % 3 == 0 ? 0.0 : 0.01 * u(rng);
    scene.ego.X_WB.yaw = 0.1 * u(rng);
    scene.ego.yaw_rate = 0.3 * u(rng);
    scene.ego.a_B = {6.0 * u(rng), 0.0};
    const Actor actor = block(1, {20.0 + 8.0 * u(rng), 4.0 * u(rng)}, {8.0 * u(rng), u(rng)});
    std::optional<double> expected;
    for (int k = 0; k <= 300 && !expected; ++k) {
      const Pose X_WB = ego_going_on(scene, 0.01 * k, as_measured);
      if (separation(scene.ego_footprint, X_WB, actor.footprint, actor_going_on(actor, 0.01 * k))
              .distance <= 0.0) {
        expected = 0.01 * k;
      }
    }
    num_conflicts += expected ? 1 : 0;
    const auto found = time_to_conflict(scene, actor, 3.0, 0.0, as_measured);
    EXPECT_NEAR(found.value_or(-1.0), expected.value_or(-1.0), 0.0201) << i;
    num_different += found.has_value() != time_to_conflict(scene, actor, 3.0, 0.0).has_value();
  }
  EXPECT_GT(num_conflicts, 60);
  EXPECT_GT(num_different, 20);
}

}  // namespace
}  // namespace saca::world::time_to_conflict_test

#include "saca/thinking/intent/likely_motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/scenes.h"

namespace saca::intent::likely_motions_test {
namespace {

Belief belief_in(Intention intention, double probability = 1.0) {
  Belief belief;
  for (IntentPosterior& posterior : belief.at) {
    posterior.fill(0.0);
    posterior[static_cast<std::size_t>(Intention::maintain)] = 1.0 - probability;
    posterior[static_cast<std::size_t>(intention)] += probability;
  }
  return belief;
}

/// The ego, and a car 40 m ahead in its lane at 10 m/s.
world::Scene with_a_car(double sideways, world::ActorKind kind = world::ActorKind::car) {
  world::Scene scene = test::ego_at(20.0);
  scene.actors.push_back(test::car(1, {40.0, 0.0}, {10.0, sideways}));
  scene.actors[0].kind = kind;
  scene.actors[0].position_sd = 0.1;
  return scene;
}

double share_aside(const std::vector<LikelyMotion>& motions) {
  double sum = 0.0;
  for (const LikelyMotion& one : motions) {
    sum += one.aside ? one.probability : 0.0;
  }
  return sum;
}

TEST(LikelyMotions, OfWhoKeepsItsLaneAreItsIntentions) {
  const world::Scene scene = with_a_car(0.0);
  const auto motions =
      likely_motions(scene, scene.actors[0], belief_in(Intention::lane_left, 0.25));
  ASSERT_EQ(motions.size(), 2U);
  EXPECT_EQ(motions[0].intention, Intention::maintain);
  EXPECT_DOUBLE_EQ(motions[0].probability, 0.75);
  EXPECT_EQ(motions[1].intention, Intention::lane_left);
  EXPECT_EQ(share_aside(motions), 0.0);
}

TEST(LikelyMotions, OfWhoMovesAsideSurelyEndAnywhereByTheStatedShare) {
  const world::Scene scene = with_a_car(2.5);
  const auto motions = likely_motions(scene, scene.actors[0], belief_in(Intention::brake_left));
  EXPECT_NEAR(share_aside(motions), side_move_share, 1e-6);
  double sum = 0.0;
  for (const LikelyMotion& one : motions) {
    sum += one.probability;
    EXPECT_EQ(one.intention, one.aside ? Intention::brake : Intention::brake_left);
    EXPECT_TRUE(!one.hard || !one.aside);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(LikelyMotions, OfPedestriansObstaclesAndWhoStandsHaveNoMoveToTheSide) {
  for (const auto kind : {world::ActorKind::pedestrian, world::ActorKind::obstacle}) {
    const world::Scene scene = with_a_car(1.5, kind);
    EXPECT_EQ(share_aside(likely_motions(scene, scene.actors[0], belief_in(Intention::maintain))),
              0.0);
  }
  world::Scene scene = with_a_car(1.5);
  scene.actors[0].v_W = {0.05, 0.0};
  EXPECT_EQ(share_aside(likely_motions(scene, scene.actors[0], belief_in(Intention::maintain))),
            0.0);
}

// Who rides along the lane and moves across it may swerve and ride on: a half, as stated. Riding
// across the road, it goes on across.
TEST(LikelyMotions, OfACyclistMaySwerve) {
  world::Scene scene = with_a_car(2.5, world::ActorKind::bicycle);
  Belief belief = belief_in(Intention::cross);
  belief.at[0][static_cast<std::size_t>(Intention::cross)] = 0.75;
  belief.at[0][static_cast<std::size_t>(Intention::stop)] = 0.25;
  const auto motions = likely_motions(scene, scene.actors[0], belief);
  EXPECT_NEAR(share_aside(motions), cyclist_side_move_share, 1e-6);
  for (const LikelyMotion& one : motions) {
    const Forecast forecast = forecast_of(one, scene, scene.actors[0], 6.0, {});
    if (one.aside) {
      if (one.intention == Intention::maintain) {
        EXPECT_NEAR(forecast.track.X_WA.back().yaw, 0.0, 1e-6) << "along the lane in the end";
      }
      EXPECT_TRUE(one.intention == Intention::maintain || one.intention == Intention::stop);
    }
  }
  scene.actors[0].v_W = {0.5, 4.0};
  EXPECT_EQ(share_aside(likely_motions(scene, scene.actors[0], belief)), 0.0);
}

// It goes on as fast along the lane, and to the side as the move has it, heading where it goes.
TEST(LikelyMotions, GoOnToTheSideAndThenAlongTheLane) {
  const world::Scene scene = with_a_car(1.0);
  const world::Actor& car = scene.actors[0];
  const LikelyMotion motion{
      1.0, Intention::maintain,
      SideMove{.probability = 1.0, .size = 2.0, .time = 2.0, .share = 0.5, .left_sd = 0.3}};
  const Forecast forecast = forecast_of(motion, scene, car, 4.0, {});
  for (const double time : {0.5, 1.0, 3.0}) {
    const Pose at = world::pose_at(forecast.track, time);
    EXPECT_NEAR(at.p.x, 40.0 + 10.0 * time, 1e-6);
    EXPECT_NEAR(at.p.y, motion.aside->way(time), 1e-6);
    EXPECT_NEAR(at.yaw, std::atan2(motion.aside->speed(time), std::hypot(10.0, 1.0)), 1e-6);
  }
  EXPECT_NEAR(world::spread_at(forecast.spread, 4.0).across_sd, std::hypot(0.1, 0.3), 1e-9);
}

// 10 m/s, and 3 m/s2 are measured: after 3.4 s it stands, having made 16.7 m, which at its first
// speed take 1.7 s of a move of 8 s. There it stays.
TEST(LikelyMotions, OfWhoStopsEndAsideWhereItStands) {
  world::Scene scene = with_a_car(1.0);
  scene.actors[0].a_W = {-3.0, 0.0};
  const LikelyMotion motion{
      1.0, Intention::brake,
      SideMove{.probability = 1.0, .size = 2.0, .time = 8.0, .share = 0.5, .left_sd = 0.3}};
  const Forecast forecast = forecast_of(motion, scene, scene.actors[0], 8.0, {});
  const Pose stands = world::pose_at(forecast.track, 3.6);
  EXPECT_NEAR(stands.p.x, 40.0 + 100.0 / 6.0, 0.1);
  EXPECT_NEAR(stands.p.y, motion.aside->way(10.0 / 6.0), 0.05);
  EXPECT_LT(stands.p.y, 0.8 * motion.aside->way(3.6));
  const Pose later = world::pose_at(forecast.track, 8.0);
  EXPECT_NEAR(later.p.x, stands.p.x, 1e-9);
  EXPECT_NEAR(later.p.y, stands.p.y, 1e-9);
}

// Three of ten who brake do it by 6 m/s2, or harder where harder is measured: after 1 s, of which
// half is the rise, 6 (1 - 0.5 / 2) are off the speed.
TEST(LikelyMotions, OfWhoBrakesAreHardToo) {
  for (const double measured : {0.0, 3.0, 8.0}) {
    world::Scene scene = with_a_car(0.0);
    scene.actors[0].v_W = {20.0, 0.0};
    scene.actors[0].a_W = {-measured, 0.0};
    const auto motions = likely_motions(scene, scene.actors[0], belief_in(Intention::brake, 0.5));
    double hard = 0.0;
    for (const LikelyMotion& one : motions) {
      if (!one.hard) {
        continue;
      }
      hard += one.probability;
      const Forecast forecast = forecast_of(one, scene, scene.actors[0], 2.0, {});
      const double speed =
          (world::pose_at(forecast.track, 1.05).p.x - world::pose_at(forecast.track, 0.95).p.x) /
          0.1;
      const double full = std::max(6.0, measured);
      EXPECT_NEAR(20.0 - speed, full - 0.25 * (full - measured), 0.02) << measured;
    }
    EXPECT_NEAR(hard, 0.5 * hard_braking_share, 1e-9);
  }
}

TEST(LikelyMotions, OfWhoStopsOrMaintainsAreNotHard) {
  const world::Scene scene = with_a_car(0.0, world::ActorKind::pedestrian);
  for (const Intention intention : {Intention::maintain, Intention::stop}) {
    for (const LikelyMotion& one :
         likely_motions(scene, scene.actors[0], belief_in(intention, 0.5))) {
      EXPECT_FALSE(one.hard);
    }
  }
}

// Off its lane's middle and moving towards it: what the law would add is left out.
TEST(LikelyMotions, DoNotMoveAsideTwice) {
  world::Scene scene = with_a_car(1.0);
  scene.actors[0].X_WA.p.y = -1.5;
  const LikelyMotion motion{1.0, Intention::maintain, SideMove{.size = 1.0, .share = 0.5}};
  const Forecast forecast = forecast_of(motion, scene, scene.actors[0], 5.0, {});
  EXPECT_NEAR(forecast.track.X_WA.back().p.y, -1.5 + 0.5, 1e-6);
}

}  // namespace
}  // namespace saca::intent::likely_motions_test

#include "saca/intent/intention.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

#include "saca/core/contract.h"

namespace saca::intent {
namespace {

using world::Actor;
using world::ActorKind;
using world::Scene;
using world::Track;

constexpr double pi = std::numbers::pi;

Scene road_scene() {
  Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9};
  scene.ego_mass = 1'700.0;
  return scene;
}

Actor car(Vec2 p_W, Vec2 v_W, Vec2 a_W = {}) {
  Actor actor{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  actor.X_WA = {p_W, norm(v_W) > 0.0 ? std::atan2(v_W.y, v_W.x) : 0.0};
  actor.v_W = v_W;
  actor.a_W = a_W;
  return actor;
}

TEST(Posterior, IsADistribution) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    Actor actor = car({30.0 * u(rng), 9.0 * u(rng)}, {20.0 * u(rng), 9.0 * u(rng)},
                      {9.0 * u(rng), 3.0 * u(rng)});
    actor.kind = static_cast<ActorKind>(i % 7);
    actor.yaw_rate = u(rng);
    const IntentPosterior p = posterior(road_scene(), actor);
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
    for (const double each : p) {
      EXPECT_GE(each, 0.0);
    }
  }
}

TEST(Posterior, SteadyDrivingIsMaintain) {
  EXPECT_EQ(likeliest(posterior(road_scene(), car({30.0, 0.0}, {20.0, 0.0}))), Intention::maintain);
}

TEST(Posterior, HardDecelerationIsBraking) {
  EXPECT_EQ(likeliest(posterior(road_scene(), car({30.0, 0.0}, {20.0, 0.0}, {-5.0, 0.0}))),
            Intention::brake);
  EXPECT_EQ(likeliest(posterior(road_scene(), car({30.0, 0.0}, {20.0, 0.0}, {5.0, 0.0}))),
            Intention::maintain);
}

TEST(Posterior, LateralSpeedIsALaneChangeToItsOwnLeft) {
  EXPECT_EQ(likeliest(posterior(road_scene(), car({30.0, -3.5}, {15.0, 1.2}))),
            Intention::lane_left);
  EXPECT_EQ(likeliest(posterior(road_scene(), car({30.0, 3.5}, {15.0, -1.2}, {-6.0, 0.0}))),
            Intention::brake_right);
  // Oncoming traffic that moves towards +y moves to its own right.
  EXPECT_EQ(likeliest(posterior(road_scene(), car({60.0, 3.5}, {-15.0, 1.2}))),
            Intention::lane_right);
}

TEST(Posterior, PedestriansAndBodiesAtRestDoNotChangeLanes) {
  Actor walker = car({20.0, 4.0}, {0.0, -1.4});
  walker.kind = ActorKind::pedestrian;
  const IntentPosterior p = posterior(road_scene(), walker);
  EXPECT_EQ(p[1] + p[2] + p[4] + p[5], 0.0);
  EXPECT_GT(p[3], 0.0);
  EXPECT_EQ(posterior(road_scene(), car({20.0, 0.0}, {}))[0], 1.0);
}

TEST(PredictedTrack, MaintainKeepsSpeedAndLane) {
  const Track track =
      predicted_track(road_scene(), car({30.0, 0.5}, {20.0, 0.0}), Intention::maintain, 4.0);
  const Pose end = pose_at(track, 4.0);
  EXPECT_NEAR(end.p.x, 110.0, 1e-9);
  EXPECT_NEAR(end.p.y, 0.5, 1e-9);
}

TEST(PredictedTrack, BrakingStopsAfterTheTextbookWay) {
  // Measured 5 m/s^2 from 20 m/s: 40 m. Not yet measured: 6 m/s^2: 33.3 m.
  const Track measured = predicted_track(road_scene(), car({0.0, 0.0}, {20.0, 0.0}, {-5.0, 0.0}),
                                         Intention::brake, 6.0);
  EXPECT_NEAR(pose_at(measured, 6.0).p.x, 40.0, 1e-9);
  const Track assumed =
      predicted_track(road_scene(), car({0.0, 0.0}, {20.0, 0.0}), Intention::brake, 6.0);
  EXPECT_NEAR(pose_at(assumed, 6.0).p.x, 400.0 / 12.0, 1e-9);
}

TEST(PredictedTrack, ALaneChangeEndsInTheNextLane) {
  const Track left =
      predicted_track(road_scene(), car({30.0, -3.5}, {15.0, 0.5}), Intention::lane_left, 5.0);
  EXPECT_NEAR(pose_at(left, 5.0).p.y, 0.0, 1e-6);
  EXPECT_NEAR(pose_at(left, 5.0).yaw, 0.0, 1e-6);
  // Already across the marking: the lane that it enters, not the one after.
  const Track entering =
      predicted_track(road_scene(), car({30.0, 1.5}, {15.0, -0.5}), Intention::lane_right, 5.0);
  EXPECT_NEAR(pose_at(entering, 5.0).p.y, 0.0, 1e-6);
  // Half a lane width is 1.75 m; 0.5 m off the centre counts as being there: one lane further.
  const Track further =
      predicted_track(road_scene(), car({30.0, 0.5}, {15.0, -0.5}), Intention::lane_right, 5.0);
  EXPECT_NEAR(pose_at(further, 5.0).p.y, -3.5, 1e-6);
}

TEST(PredictedTrack, OncomingTrafficKeepsItsDirection) {
  Scene scene = road_scene();
  scene.road.curvature = 0.01;
  const Pose X_WA = world::from_lane(scene.road, {.s = 60.0, .d = 3.5, .heading = pi});
  Actor actor = car(X_WA.p, rotated({10.0, 0.0}, X_WA.yaw));
  const Track track = predicted_track(scene, actor, Intention::maintain, 2.0);
  const world::LanePose end = world::to_lane(scene.road, pose_at(track, 2.0));
  EXPECT_NEAR(end.d, 3.5, 1e-6);
  EXPECT_LT(end.s, 42.0);  // 20 m back along the arc, which is shorter on the inside: 20 / 0.965
  EXPECT_NEAR(end.s, 60.0 - 20.0 / 0.965, 1e-6);
}

TEST(PredictedTrack, CrossingTrafficGoesStraightAndBrakesStraight) {
  const Actor truck = car({16.0, 6.4}, {0.0, -7.5});
  const Pose end = pose_at(predicted_track(road_scene(), truck, Intention::maintain, 2.0), 2.0);
  EXPECT_NEAR(end.p.x, 16.0, 1e-9);
  EXPECT_NEAR(end.p.y, -8.6, 1e-9);
  EXPECT_NEAR(end.yaw, -pi / 2.0, 1e-9);
}

TEST(PredictedTrack, NoSegmentIsFasterThanTheActorIs) {
  for (const Intention intention : all_intentions) {
    const Track track =
        predicted_track(road_scene(), car({30.0, 0.0}, {18.0, 0.0}), intention, 6.0);
    for (int k = 0; k < 120; ++k) {
      EXPECT_LE(norm(velocity_at(track, 0.05 * k)), 18.2)
          << name(intention);  // a lane change adds 1.6 m/s sideways
    }
  }
}

// At most 30/16 of the mean slope: 3.5 m over 60 m is 6.3 deg, braking or not.
TEST(PredictedTrack, ABrakingLaneChangeDoesNotEndBroadside) {
  const Track track =
      predicted_track(road_scene(), car({30.0, 0.0}, {15.0, 0.4}), Intention::brake_left, 6.0);
  for (const Pose& X : track.X_WA) {
    EXPECT_LT(std::abs(X.yaw), 0.12);
  }
}

TEST(PredictedTrack, RefusesAnEmptyHorizon) {
  EXPECT_THROW((void)predicted_track(road_scene(), car({}, {1.0, 0.0}), Intention::maintain, 0.0),
               ContractViolation);
}

}  // namespace
}  // namespace saca::intent

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/thinking/rollout/encounters_for_test.h"

namespace saca::rollout::judge_test {
namespace {

using collision::Contact;
using collision::Face;
using collision::far_away;
using collision::HarmModel;
using collision::Injury;
using collision::occupant_harm;
using collision::occupant_injury;
using collision::Outcome;
using collision::Side;
using collision::unprotected_harm;
using world::ActorKind;
using world::Beyond;

constexpr double pi = std::numbers::pi;
constexpr world::Footprint person{.shape = world::Shape::ellipse, .length = 0.3, .width = 0.5};

const HarmModel& harm() {
  static const HarmModel model = shipped_harm();
  return model;
}

Encounter driving(double speed, double duration = 5.0) {
  Encounter encounter;
  encounter.motion = steady_ego({}, {speed, 0.0}, 0.0, duration);
  return encounter;
}

TEST(Judge, AnEmptySceneHasNeitherContactNorHarm) {
  const Outcome outcome = driving(15.0).judged(harm());
  EXPECT_FALSE(outcome.contact);
  EXPECT_EQ(outcome.collision_loss, 0.0);
  EXPECT_EQ(outcome.harm, 0.0);
  EXPECT_EQ(outcome.clearance, far_away);
  EXPECT_FALSE(outcome.nearest);
  EXPECT_DOUBLE_EQ(outcome.end_time, 5.0);
}

// 45.3 m of gap close at 25 m/s. Equal masses, central: each changes by half of 25 (1 + 0.1).
TEST(Judge, HeadOn) {
  Encounter encounter = driving(15.0);
  encounter.add_car({{50.0, 0.0}, pi}, {-10.0, 0.0});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  const Contact& contact = *outcome.contact;
  EXPECT_EQ(contact.actor, 0U);
  EXPECT_FALSE(contact.edge);
  EXPECT_NEAR(contact.time, 45.3 / 25.0, 1e-3 / 25.0);
  EXPECT_EQ(contact.ego_face, Face::front);
  EXPECT_EQ(contact.other_face, Face::front);
  EXPECT_NEAR(contact.p_W.x, 15.0 * 45.3 / 25.0 + 2.35, 2e-3);
  EXPECT_NEAR(contact.p_W.y, 0.0, 1e-9);
  EXPECT_NEAR(contact.v_rel_W.x, -25.0, 1e-9);
  EXPECT_NEAR(contact.ego_delta_v, 13.75, 1e-6);
  EXPECT_NEAR(contact.other_delta_v, 13.75, 1e-6);
  EXPECT_NEAR(outcome.collision_loss, 0.35 * 25.0, 1e-9);
  EXPECT_NEAR(outcome.harm, 3.0 * occupant_harm(harm(), Face::front, 13.75), 1e-6);
  EXPECT_EQ(outcome.clearance, 0.0);
  EXPECT_FALSE(outcome.nearest);
  EXPECT_GT(outcome.end_time, contact.time);  // it slides on
}

TEST(Judge, RunningIntoAndBeingRunIntoFromBehind) {
  Encounter into = driving(15.0);
  into.add_car({{20.0, 0.2}, 0.0}, {5.0, 0.0});
  const Outcome first = into.judged(harm());
  ASSERT_TRUE(first.contact);
  EXPECT_EQ(first.contact->ego_face, Face::front);
  EXPECT_EQ(first.contact->other_face, Face::rear);
  EXPECT_NEAR(first.collision_loss, 3.5, 1e-9);

  Encounter from_behind = driving(5.0);
  from_behind.add_car({{-20.0, -0.2}, 0.0}, {15.0, 0.0});
  const Outcome second = from_behind.judged(harm());
  ASSERT_TRUE(second.contact);
  EXPECT_EQ(second.contact->ego_face, Face::rear);
  EXPECT_EQ(second.contact->other_face, Face::front);
  EXPECT_NEAR(second.collision_loss, 2.1, 1e-9);
  // The same crash seen from the other car: what is exchanged is exchanged, the harm is one.
  EXPECT_NEAR(second.contact->time, first.contact->time, 1e-4);
  EXPECT_NEAR(second.contact->ego_delta_v, first.contact->other_delta_v, 1e-4);
  EXPECT_NEAR(second.harm, first.harm, 1e-6);
}

// A truck from the right into the ego's side; friction and offset leave the delta-v below the
// plastic bound with restitution, and momentum fixes the ratio.
TEST(Judge, StruckInTheSide) {
  Encounter encounter = driving(0.0);
  encounter.add(ActorKind::truck, {.length = 8.0, .width = 2.5}, 12'000.0,
                {{{0.0, -20.0}, pi / 2.0}, {0.0, 10.0}});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->ego_face, Face::right);
  EXPECT_EQ(outcome.contact->other_face, Face::front);
  EXPECT_NEAR(outcome.contact->time, (20.0 - 4.0 - 0.95) / 10.0, 1e-4);
  EXPECT_NEAR(outcome.contact->ego_delta_v, 1.1 * 10.0 * 12'000.0 / 13'700.0, 1e-6);
  EXPECT_NEAR(1700.0 * outcome.contact->ego_delta_v, 12'000.0 * outcome.contact->other_delta_v,
              1e-6);
  EXPECT_NEAR(outcome.collision_loss, 4.1, 1e-9);
  EXPECT_GT(outcome.harm, 1.5 * occupant_harm(harm(), Face::front, 9.0));
}

// Side by side, drifting together at 0.3 m/s: a light impact at the side, however fast both drive.
TEST(Judge, GrazingIsAtTheSideAndLight) {
  Encounter encounter = driving(20.0);
  encounter.add_car({{0.5, 2.2}, 0.0}, {20.5, -0.3});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->ego_face, Face::left);
  EXPECT_EQ(outcome.contact->other_face, Face::right);
  EXPECT_NEAR(outcome.contact->time, 0.3 / 0.3, 1e-3);
  EXPECT_LT(outcome.contact->ego_delta_v, 0.5);
  EXPECT_NEAR(outcome.collision_loss, 0.41 * std::hypot(0.5, 0.3), 1e-9);
}

// A car stands 30 degrees askew, its nose across the ego's way: the ego's front left corner runs
// into it. The impact comes from 30 degrees beside the ego's nose, so in front; it is off the ego's
// centre, so lighter than a full one, which would be 10 (1 + 0.1) / 2.
TEST(Judge, AGlancingCorner) {
  Encounter encounter = driving(10.0);
  const Pose X_WO{{20.0, 2.0}, pi + pi / 6.0};
  encounter.add_car(X_WO, {});
  const Vec2 left = X_WO * Vec2{2.35, 0.95};  // ends of its nose
  const Vec2 right = X_WO * Vec2{2.35, -0.95};
  const double share = (left.y - 0.95) / (left.y - right.y);
  ASSERT_GT(share, 0.0);
  ASSERT_LT(share, 1.0);
  const Vec2 met = left + share * (right - left);
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->time, (met.x - 2.35) / 10.0, 1e-4);
  EXPECT_LT(norm(outcome.contact->p_W - met), 0.1);  // the corner, widened by 0.1 m of depth
  EXPECT_NEAR(outcome.contact->n_W.x, std::cos(pi / 6.0), 1e-6);
  EXPECT_EQ(outcome.contact->ego_face, Face::front);
  EXPECT_EQ(outcome.contact->other_face, Face::front);
  EXPECT_GT(outcome.contact->ego_delta_v, 2.0);
  EXPECT_LT(outcome.contact->ego_delta_v, 5.5);
}

// The ego turns on the spot; its front right corner sweeps into a post beside it.
TEST(Judge, ATurningEgoMeetsWhatItsCornerSweeps) {
  Encounter encounter;
  encounter.motion = steady_ego({}, {}, -1.0, 1.5);
  encounter.add(ActorKind::obstacle, {.shape = world::Shape::ellipse, .length = 0.2, .width = 0.2},
                1.0, {{{0.0, -2.0}, 0.0}, {}});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  // The side line (0.95 from the centre) touches the post, 2.0 away: never, until the corner comes
  // by (radius 2.535); its front comes at the angle where cos(angle) 2.0 ... by the front edge: the
  // post, at angle a behind the ego's nose, is 2 cos(a) ahead and 2 sin(a) aside; front face
  // at 2.35 is never reached as 2 + 0.1 < 2.35, so the side meets it: 2 sin(a) = 0.95 + 0.1.
  const double angle = std::asin(1.05 / 2.0);
  EXPECT_NEAR(outcome.contact->time, pi / 2.0 - angle, 1e-3 / 2.0);
  EXPECT_EQ(outcome.contact->ego_face, Face::right);
  EXPECT_EQ(outcome.contact->relative_speed, 0.0);  // both centres stand
  EXPECT_GT(outcome.contact->ego_delta_v, 0.0);     // the side does not
}

TEST(Judge, APedestrianIsHurtByTheClosingSpeedAndTheEgoHardly) {
  Encounter encounter = driving(10.0);
  encounter.add(ActorKind::pedestrian, person, 75.0, {{{30.0, -0.5}, pi / 2.0}, {}});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->ego_delta_v * 1700.0, outcome.contact->other_delta_v * 75.0, 1e-6);
  const double alone = unprotected_harm(harm(), ActorKind::pedestrian, 10.0);
  EXPECT_NEAR(outcome.harm, alone, 0.01);
  EXPECT_GE(outcome.harm, alone);
}

TEST(Judge, AnObstacleDoesNotGiveWayWhateverItsMass) {
  Encounter encounter = driving(10.0);
  encounter.add(ActorKind::obstacle, {.length = 1.0, .width = 4.0}, 1.0, {{{30.0, 0.0}, 0.0}, {}});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->ego_delta_v, 11.0, 1e-6);
  EXPECT_EQ(outcome.contact->other_delta_v, 0.0);
  EXPECT_NEAR(outcome.harm, 1.5 * occupant_harm(harm(), Face::front, 11.0), 1e-6);
}

TEST(Judge, TheFirstOfSeveralCounts) {
  Encounter encounter = driving(15.0);
  encounter.add_car({{80.0, 0.0}, 0.0}, {});
  encounter.add_car({{40.0, 0.5}, 0.0}, {});
  encounter.add_car({{60.0, -0.5}, 0.0}, {});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->actor, 1U);
  EXPECT_NEAR(outcome.contact->time, (40.0 - 4.7) / 15.0, 1e-4);
}

TEST(Judge, ExistenceScalesTheHarmOnly) {
  Encounter encounter = driving(15.0);
  encounter.add_car({{40.0, 0.0}, 0.0}, {});
  const Outcome sure = encounter.judged(harm());
  encounter.scene.actors[0].existence = 0.25;
  const Outcome doubtful = encounter.judged(harm());
  EXPECT_DOUBLE_EQ(doubtful.harm, 0.25 * sure.harm);
  EXPECT_EQ(doubtful.collision_loss, sure.collision_loss);
}

TEST(Judge, OverlapAtTheStartIsContactAtOnce) {
  Encounter encounter = driving(10.0);
  encounter.add_car({{4.5, 0.0}, 0.0}, {});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_EQ(outcome.contact->time, 0.0);
  EXPECT_EQ(outcome.contact->ego_face, Face::front);
  EXPECT_EQ(outcome.contact->other_face, Face::rear);
  // Moving apart, nothing is exchanged.
  encounter.motion = steady_ego({}, {-10.0, 0.0}, 0.0, 1.0);
  EXPECT_EQ(encounter.judged(harm()).harm, 0.0);
}

TEST(Judge, AnEgoThatEndedAtRestCanStillBeRunInto) {
  Encounter encounter = driving(0.0, 0.5);
  encounter.motion.ended = true;
  encounter.add_car({{-30.0, 0.0}, 0.0}, {10.0, 0.0});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->time, 2.53, 1e-4);
  EXPECT_EQ(outcome.contact->ego_face, Face::rear);
  EXPECT_NEAR(outcome.contact->relative_speed, 10.0, 1e-9);
  // A motion that is cut short says nothing of what comes after.
  encounter.motion.ended = false;
  EXPECT_FALSE(encounter.judged(harm()).contact);
}

TEST(Judge, AnEgoThatRecoveredItsLaneGoesOnAlongIt) {
  Encounter encounter = driving(10.0, 1.0);
  encounter.scene.road.curvature = 0.02;
  encounter.motion.track = {};
  for (int k = 0; k <= 100; ++k) {
    encounter.motion.track.X_WA.push_back(from_lane(encounter.scene.road, {0.1 * k, 0.0, 0.0}));
  }
  encounter.motion.ended = true;
  // 25 m along the bend stands a post; its near side is 24.9 m on, the ego's bumper 2.35 m ahead.
  const Pose X_WP = from_lane(encounter.scene.road, {25.0, 0.0, 0.0});
  encounter.add(ActorKind::obstacle, {.shape = world::Shape::ellipse, .length = 0.2, .width = 0.2},
                1.0, {X_WP, {}});
  const Outcome outcome = encounter.judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_NEAR(outcome.contact->time, (25.0 - 0.1 - 2.35) / 10.0, 0.01);  // the bend's chord
  EXPECT_NEAR(outcome.contact->relative_speed, 10.0, 1e-9);
  encounter.motion.ended = false;
  EXPECT_FALSE(encounter.judged(harm()).contact);
}

TEST(Judge, AnActorStillMovingWhenItsTrackEndsIsNotInventedFurther) {
  Encounter encounter = driving(15.0, 5.0);
  encounter.add(ActorKind::car, encounter.scene.ego_footprint, 1700.0,
                {{{20.0, 0.0}, 0.0}, {15.0, 0.0}, 0.0, 2.0});
  EXPECT_FALSE(encounter.judged(harm()).contact);  // as far ahead as ever when last heard of
  EXPECT_NEAR(encounter.judged(harm()).clearance, 20.0 - 4.7, 1e-3);
}

TEST(Judge, WithoutContactTellsTheClearance) {
  Encounter encounter = driving(15.0);
  encounter.add_car({{40.0, 3.2}, pi}, {-15.0, 0.0});
  encounter.add_car({{30.0, -5.0}, 0.0}, {});
  const Outcome passing = encounter.judged(harm());
  EXPECT_NEAR(passing.clearance, 3.2 - 1.9, 1e-3);
  // 40 m apart and closing at 30 m/s, they are abreast once a length less remains.
  ASSERT_TRUE(passing.nearest);
  EXPECT_EQ(passing.nearest->actor, 0U);
  EXPECT_GT(passing.nearest->time, (40.0 - 4.7) / 30.0 - 0.02);
  EXPECT_LT(passing.nearest->time, (40.0 + 4.7) / 30.0 + 0.02);
  encounter.scene.road.right_edge = -1.75;
  encounter.scene.road.right_beyond = Beyond::barrier;
  const Outcome beside = encounter.judged(harm());
  EXPECT_NEAR(beside.clearance, 1.75 - 0.95, 1e-3);
  ASSERT_TRUE(beside.nearest);
  EXPECT_FALSE(beside.nearest->actor);
  EXPECT_EQ(beside.nearest->edge, Side::right);
  encounter.scene.road.right_beyond = Beyond::unmarked;  // open ground is nothing to keep clear of
  EXPECT_NEAR(encounter.judged(harm()).clearance, 1.3, 1e-3);
}

// --- edges of the road ---

Encounter leaving_to_the_left(Beyond beyond, double speed, double angle) {
  Encounter encounter;
  encounter.motion = steady_ego({{}, angle}, rotated({speed, 0.0}, angle), 0.0, 5.0);
  encounter.scene.road.left_edge = 3.0;
  encounter.scene.road.left_beyond = beyond;
  return encounter;
}

TEST(Judge, ABarrierTakesTheSpeedAcrossIt) {
  const double angle = 0.2;
  const Outcome outcome = leaving_to_the_left(Beyond::barrier, 15.0, angle).judged(harm());
  ASSERT_TRUE(outcome.contact);
  EXPECT_FALSE(outcome.contact->actor);
  EXPECT_EQ(outcome.contact->edge, Side::left);
  EXPECT_EQ(outcome.contact->ego_face, Face::left);
  const double reach = 2.35 * std::sin(angle) + 0.95 * std::cos(angle);
  EXPECT_NEAR(outcome.contact->time, (3.0 - reach) / (15.0 * std::sin(angle)), 1e-3 / 15.0);
  // The corner's arm about the centre of mass (2.11 along the barrier) lightens the impact.
  EXPECT_GT(outcome.contact->ego_delta_v, 0.2 * 15.0 * std::sin(angle));
  EXPECT_LT(outcome.contact->ego_delta_v, 1.3 * 15.0 * std::sin(angle));
  EXPECT_NEAR(outcome.collision_loss, 0.41 * 15.0, 1e-9);
}

TEST(Judge, TreesStopTheCarAndOpenGroundSlowsIt) {
  const Outcome trees = leaving_to_the_left(Beyond::trees, 15.0, 0.2).judged(harm());
  ASSERT_TRUE(trees.contact);
  EXPECT_NEAR(trees.contact->ego_delta_v, 15.0, 1e-9);
  EXPECT_EQ(trees.contact->ego_face, Face::front);
  EXPECT_NEAR(trees.harm, 1.5 * occupant_harm(harm(), Face::front, 15.0), 1e-9);
  const Outcome open = leaving_to_the_left(Beyond::unmarked, 15.0, 0.2).judged(harm());
  ASSERT_TRUE(open.contact);
  EXPECT_NEAR(open.contact->ego_delta_v, 0.25 * 15.0, 1e-9);
  EXPECT_NEAR(open.collision_loss, 0.35 * 0.25 * 15.0, 1e-9);
  EXPECT_DOUBLE_EQ(open.end_time, 5.0);  // it rolls on
  EXPECT_LT(open.harm, trees.harm);
}

TEST(Judge, WhatIsHitAfterAKerbIsAddedToIt) {
  Encounter encounter = leaving_to_the_left(Beyond::kerb, 15.0, 0.2);
  const Outcome kerb = encounter.judged(harm());
  const double kerb_alone = kerb.harm;
  EXPECT_GT(kerb_alone, 0.0);
  encounter.add(ActorKind::pedestrian, person, 75.0, {{{40.0, 40.0 * std::tan(0.2)}, 0.0}, {}});
  const Outcome both = encounter.judged(harm());
  ASSERT_TRUE(both.contact);
  EXPECT_EQ(both.contact->actor, 0U);
  encounter.scene.road.left_edge = 200.0;
  const Outcome alone = encounter.judged(harm());
  // The ego's people suffer both, so that the chances of coming through multiply.
  const Injury by_kerb = occupant_injury(harm(), kerb.contact->ego_face, kerb.contact->ego_delta_v);
  const Injury by_blow =
      occupant_injury(harm(), alone.contact->ego_face, alone.contact->ego_delta_v);
  const double twice =
      1.5 * (by_kerb.severe * by_blow.severe + 4.0 * by_kerb.killed * by_blow.killed);
  EXPECT_NEAR(both.harm, kerb_alone + alone.harm - twice, 1e-9);
}

// --- properties ---

Encounter random_encounter(std::mt19937& rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Encounter encounter;
  encounter.motion =
      steady_ego({}, {12.0 + 5.0 * uniform(rng), uniform(rng)}, 0.5 * uniform(rng), 3.0);
  for (int i = 0; i < 3; ++i) {
    const double yaw = pi * uniform(rng);
    encounter.add_car({{30.0 + 15.0 * uniform(rng), 15.0 * uniform(rng)}, yaw},
                      rotated({8.0 + 6.0 * uniform(rng), 0.0}, yaw), 0.3 * uniform(rng));
  }
  encounter.add(ActorKind::pedestrian, person, 75.0,
                {{{20.0 + 10.0 * uniform(rng), 6.0 * uniform(rng)}, pi * uniform(rng)},
                 {uniform(rng), uniform(rng)}});
  encounter.scene.road.left_edge = 8.0;
  encounter.scene.road.left_beyond = Beyond::barrier;
  encounter.scene.road.right_edge = -7.0;
  encounter.scene.road.right_beyond = Beyond::trees;
  encounter.scene.road.curvature = 0.01 * uniform(rng);
  return encounter;
}

template <class PoseMap, class VectorMap>
Encounter moved(Encounter encounter, PoseMap&& pose, VectorMap&& body_vector, double turn) {
  for (Pose& X_WB : encounter.motion.track.X_WA) {
    X_WB = pose(X_WB);
  }
  for (Vec2& v_B : encounter.motion.v_B) {
    v_B = body_vector(v_B);
  }
  for (double& rate : encounter.motion.yaw_rate) {
    rate *= turn;
  }
  for (world::Track& track : encounter.tracks) {
    std::transform(track.X_WA.begin(), track.X_WA.end(), track.X_WA.begin(), pose);
  }
  encounter.scene.road.X_WL = pose(encounter.scene.road.X_WL);
  return encounter;
}

TEST(Judge, DoesNotDependOnTheWorldsFrame) {
  std::mt19937 rng(1);
  int contacts = 0;
  for (int i = 0; i < 100; ++i) {
    const Encounter original = random_encounter(rng);
    const Pose X_VW{{500.0, -300.0}, i % 2 == 0 ? pi / 2.0 : 2.1};
    const Encounter turned = moved(
        original, [&](const Pose& X) { return X_VW * X; }, [](Vec2 v) { return v; }, 1.0);
    const Outcome a = original.judged(harm());
    const Outcome b = turned.judged(harm());
    EXPECT_NEAR(a.harm, b.harm, 1e-5) << i;
    EXPECT_NEAR(a.collision_loss, b.collision_loss, 1e-5) << i;
    EXPECT_NEAR(a.clearance, b.clearance, 1e-5) << i;
    ASSERT_EQ(a.contact.has_value(), b.contact.has_value()) << i;
    if (a.contact) {
      ++contacts;
      EXPECT_EQ(a.contact->actor, b.contact->actor);
      EXPECT_EQ(a.contact->ego_face, b.contact->ego_face);
      EXPECT_EQ(a.contact->other_face, b.contact->other_face);
      EXPECT_LT(norm(X_VW * a.contact->p_W - b.contact->p_W), 1e-4);
    }
  }
  EXPECT_GT(contacts, 20);
}

// The first contact is found in the same way; only what slides on afterwards is less exact.
TEST(JudgeContacts, DiffersFromJudgeOnlyInWhatFollowsTheFirst) {
  std::mt19937 rng(3);
  int contacts = 0;
  double harm_sum = 0.0;
  double difference = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Encounter encounter = random_encounter(rng);
    const Outcome fine = encounter.judged(harm());
    const Outcome coarse =
        judge_contacts(encounter.motion, encounter.scene, encounter.tracks, harm());
    const Outcome reacting = judge_contacts(
        encounter.motion, encounter.scene,
        [&](const manoeuvre::EgoMotion&) { return encounter.tracks; }, harm());
    EXPECT_EQ(reacting.harm, coarse.harm) << i;
    EXPECT_EQ(coarse.clearance, 0.0);
    ASSERT_EQ(fine.contact.has_value(), coarse.contact.has_value()) << i;
    if (fine.contact) {
      ++contacts;
      EXPECT_EQ(fine.contact->actor, coarse.contact->actor) << i;
      EXPECT_NEAR(fine.contact->time, coarse.contact->time, 1e-4) << i;
      EXPECT_NEAR(fine.collision_loss, coarse.collision_loss, 1e-3) << i;
    }
    harm_sum += fine.harm;
    difference += std::abs(fine.harm - coarse.harm);
  }
  EXPECT_GT(contacts, 50);
  EXPECT_LT(difference, 0.01 * harm_sum);
}

Face mirrored(Face face) {
  return face == Face::left ? Face::right : face == Face::right ? Face::left : face;
}

TEST(Judge, IsMirrorSymmetric) {
  std::mt19937 rng(2);
  for (int i = 0; i < 100; ++i) {
    const Encounter original = random_encounter(rng);
    Encounter flipped = moved(
        original,
        [](const Pose& X) {
          return Pose{{X.p.x, -X.p.y}, -X.yaw};
        },
        [](Vec2 v) {
          return Vec2{v.x, -v.y};
        },
        -1.0);
    world::Road& road = flipped.scene.road;
    road.curvature = -road.curvature;
    road.left_edge = -original.scene.road.right_edge;
    road.right_edge = -original.scene.road.left_edge;
    std::swap(road.left_beyond, road.right_beyond);
    const Outcome a = original.judged(harm());
    const Outcome b = flipped.judged(harm());
    EXPECT_NEAR(a.harm, b.harm, 1e-6) << i;
    EXPECT_NEAR(a.collision_loss, b.collision_loss, 1e-6) << i;
    EXPECT_NEAR(a.clearance, b.clearance, 1e-6) << i;
    ASSERT_EQ(a.contact.has_value(), b.contact.has_value()) << i;
    if (a.contact) {
      EXPECT_EQ(a.contact->actor, b.contact->actor);
      EXPECT_EQ(mirrored(a.contact->ego_face), b.contact->ego_face);
      if (a.contact->actor) {
        EXPECT_EQ(mirrored(a.contact->other_face), b.contact->other_face);
      }
    }
  }
}

TEST(Judge, FromTheOtherCarsSeatSwapsWhatItShould) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int contacts = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_WO{{25.0 + 5.0 * uniform(rng), 8.0 * uniform(rng)}, pi * uniform(rng)};
    const Vec2 v_ego{12.0, 2.0 * uniform(rng)};
    const Vec2 v_other = rotated({8.0, 0.0}, X_WO.yaw);
    Encounter mine;
    mine.motion = steady_ego({}, v_ego, 0.2, 3.0);
    mine.add(ActorKind::car, mine.scene.ego_footprint, 1700.0, {X_WO, v_other, -0.3, 3.0});
    Encounter theirs;
    theirs.motion = steady_ego(X_WO, v_other, -0.3, 3.0);
    theirs.add(ActorKind::car, mine.scene.ego_footprint, 1700.0, {{}, v_ego, 0.2, 3.0});
    const Outcome a = mine.judged(harm());
    const Outcome b = theirs.judged(harm());
    ASSERT_EQ(a.contact.has_value(), b.contact.has_value()) << i;
    EXPECT_NEAR(a.harm, b.harm, 1e-3 * a.harm + 1e-9)
        << i;  // times differ by up to 0.1 mm of travel
    EXPECT_NEAR(a.clearance, b.clearance, 1e-3);
    if (a.contact) {
      ++contacts;
      EXPECT_EQ(a.contact->ego_face, b.contact->other_face);
      EXPECT_EQ(a.contact->other_face, b.contact->ego_face);
      EXPECT_NEAR(a.contact->ego_delta_v, b.contact->other_delta_v, 1e-3 * 20.0);
      EXPECT_NEAR(a.contact->relative_speed, b.contact->relative_speed, 1e-2);
    }
  }
  EXPECT_GT(contacts, 20);
}

TEST(Judge, HarmGrowsWithSpeed) {
  double previous = 0.0;
  for (const double speed : {2.0, 5.0, 10.0, 15.0, 20.0, 25.0}) {
    Encounter encounter = driving(speed, 12.0);
    encounter.add_car({{20.0, 0.4}, 0.0}, {});
    const double now = encounter.judged(harm()).harm;
    EXPECT_GT(now, previous) << speed;
    previous = now;
  }
}

TEST(Judge, RefusesWhatDoesNotFitTogether) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Encounter encounter = driving(10.0, 1.0);
  encounter.add_car({{30.0, 0.0}, 0.0}, {});
  Encounter bad = encounter;
  bad.tracks.clear();
  EXPECT_THROW((void)bad.judged(harm()), ContractViolation);
  bad = encounter;
  bad.motion.v_B.pop_back();
  EXPECT_THROW((void)bad.judged(harm()), ContractViolation);
  bad = encounter;
  bad.motion = {};
  EXPECT_THROW((void)bad.judged(harm()), ContractViolation);
  bad = encounter;
  bad.motion.track.X_WA[50].yaw = nan;
  EXPECT_THROW((void)bad.judged(harm()), ContractViolation);
  bad = encounter;
  bad.tracks[0].X_WA[3].p.y = nan;
  EXPECT_THROW((void)bad.judged(harm()), ContractViolation);
  bad = encounter;
  bad.scene.ego_footprint.width = 0.0;
  EXPECT_THROW((void)bad.judged(harm()), ContractViolation);
}

}  // namespace
}  // namespace saca::rollout::judge_test

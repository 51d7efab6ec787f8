#include "saca/thinking/preview/expected_harm.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/preview/forecast_for_test.h"
#include "saca/thinking/rollout/batch.h"
#include "tests/support/scenes.h"

namespace saca::preview::expected_harm_test {
namespace {

using atlas::small_atlas_car;
using manoeuvre::PolicyId;
using world::Scene;

/// 12.5 m/s on grip 0.85, a car so far ahead of the bumper, at this speed.
Scene behind_a_car(double gap, double speed) {
  Scene scene = test::ego_at(12.5, manoeuvre::footprint(small_atlas_car()));
  scene.ego_mass = small_atlas_car().mass;
  scene.grip = 0.85;
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -5.25;
  const double front = support(scene.ego_footprint, {}, {1.0, 0.0}).x;
  scene.actors.push_back(test::car(1, {front + gap + 2.25, 0.0}, {speed, 0.0}));
  return scene;
}

const ExpectedHarm& of(const std::vector<ExpectedHarm>& all, PolicyId policy) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const ExpectedHarm& one) { return one.plan.policy == policy; });
}

TEST(ExpectedHarm, IsTheMeanOverTheMotionsByTheirWeights) {
  const Scene scene = behind_a_car(14.0, 0.0);
  const JointMotion stands = all_going_on(scene);
  JointMotion away = stands;  // far down the road
  for (Pose& pose : away.tracks[0].X_WA) {
    pose.p.x += 500.0;
  }
  JointMotion weighted_stands = stands;
  weighted_stands.probability = 0.3;
  JointMotion weighted_away = away;
  weighted_away.probability = 0.9;  // weights need not sum to 1
  const JointMotion both[] = {weighted_stands, weighted_away};
  for (const Physics physics : {Physics::atlas, Physics::rolled_out}) {
    const auto hit = expected_harms(scene, {&stands, 1}, reading(), physics);
    const auto clear = expected_harms(scene, {&away, 1}, reading(), physics);
    const auto mixed = expected_harms(scene, both, reading(), physics);
    ASSERT_EQ(mixed.size(), forecast::all_plans(scene.ego.v_B.x).size());
    EXPECT_GT(of(hit, PolicyId::no_intervention).harm, 0.0);
    for (std::size_t i = 0; i < mixed.size(); ++i) {
      EXPECT_NEAR(mixed[i].harm, 0.25 * hit[i].harm + 0.75 * clear[i].harm, 1e-12);
      EXPECT_NEAR(mixed[i].contact, 0.25 * hit[i].contact + 0.75 * clear[i].contact, 1e-12);
    }
  }
}

// Where a stop ends does not depend on how coarsely it is looked at: 5 cm less room than it takes,
// by the exact roll-out, and it hits; 5 cm more, and it does not.
TEST(ExpectedHarm, AStopEndsWhereItEnds) {
  const std::array brakes{manoeuvre::full_braking};
  for (const double speed : {12.5, 13.0, 13.7, 14.2}) {
    const auto at = [&](double gap) {
      Scene scene = behind_a_car(gap, 0.0);
      scene.ego.v_B.x = speed;
      return scene;
    };
    const Scene far = at(30.0);
    const auto stop = rolled_out(far, all_going_on(far).tracks, brakes, rolling());
    const double way = 30.0 - stop[0].outcome().clearance;
    for (const double more : {-0.05, 0.05}) {
      const Scene scene = at(way + more);
      const JointMotion stands = all_going_on(scene);
      const auto told = expected_harms(scene, {&stands, 1}, rolling(), Physics::rolled_out, brakes);
      EXPECT_EQ(told[0].contact, more < 0.0 ? 1.0 : 0.0) << speed << " " << more;
    }
  }
}

// Begun 0.2 s later a stop ends 0.2 s of the speed further on.
TEST(ExpectedHarm, AStopThatBeginsLaterEndsLater) {
  const std::array brakes{manoeuvre::full_braking};
  const Scene far = behind_a_car(40.0, 0.0);
  const auto stop = rolled_out(far, all_going_on(far).tracks, brakes, rolling());
  const double way = 40.0 - stop[0].outcome().clearance + 0.2 * far.ego.v_B.x;
  for (const double more : {-0.05, 0.05}) {
    const Scene scene = behind_a_car(way + more, 0.0);
    const JointMotion stands = all_going_on(scene);
    const auto told = PreparedMotions(scene, {&stands, 1}, rolling()).harms_later(0.2, brakes);
    EXPECT_EQ(told[0].contact, more < 0.0 ? 1.0 : 0.0) << more;
    EXPECT_EQ(told[0].harm > 0.0, more < 0.0) << more;
    EXPECT_EQ(told[0].plan, manoeuvre::full_braking);
  }
}

// A driver brakes with 4 m/s2. Going on lets go of the brakes: what begins 0.4 s later starts as it
// does from a car that rolls as fast, and not with the pressure of before.
TEST(ExpectedHarm, BrakesThatWereLetGoOfBuildUpAnew) {
  constexpr double delay = 0.4;
  const std::array brakes{manoeuvre::full_braking};
  Scene far = behind_a_car(40.0, 0.0);
  far.ego.a_B = {-4.0, 0.0};
  const rollout::Drive drive =
      rollout::drive_from(small_atlas_car(), manoeuvre::doing_nothing, far, delay);
  const manoeuvre::EgoMotion going_on = rollout::drive_all({&drive, 1}, delay).front();
  Scene rolls = far;
  rolls.ego = {.X_WB = going_on.track.X_WA.back(), .v_B = going_on.v_B.back()};
  const auto stop = rolled_out(rolls, all_going_on(rolls).tracks, brakes, rolling());
  const double way = 40.0 - stop[0].outcome().clearance;
  for (const double more : {-0.1, 0.1}) {
    Scene scene = behind_a_car(way + more, 0.0);
    scene.ego.a_B = far.ego.a_B;
    const JointMotion stands = all_going_on(scene);
    const auto told = PreparedMotions(scene, {&stands, 1}, rolling()).harms_later(delay, brakes);
    EXPECT_EQ(told[0].contact, more < 0.0 ? 1.0 : 0.0) << more;
  }
}

TEST(ExpectedHarm, WithoutADelayWhatBeginsLaterBeginsNow) {
  const Scene scene = behind_a_car(14.0, 4.0);
  const JointMotion motion = all_going_on(scene);
  const forecast::Plans plans = forecast::all_plans(scene.ego.v_B.x);
  const auto now = expected_harms(scene, {&motion, 1}, rolling(), Physics::rolled_out);
  const PreparedMotions prepared(scene, {&motion, 1}, rolling());
  const auto later = prepared.harms_later(0.0, {plans.begin(), plans.size()});
  ASSERT_EQ(later.size(), now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(later[i].plan, now[i].plan);
    EXPECT_EQ(later[i].refusal, now[i].refusal);
    EXPECT_EQ(later[i].harm, now[i].harm);
    EXPECT_EQ(later[i].contact, now[i].contact);
  }
  for (const double never : {-0.1, motion_horizon, std::nan("")}) {
    EXPECT_THROW((void)prepared.harms_later(never, {plans.begin(), plans.size()}),
                 ContractViolation);
  }
}

// Something that is there once in twenty times stands before a car that is there: where it is not,
// the car is hit all the same. Two such, one behind the other, likewise.
TEST(ExpectedHarm, WhoMayNotBeThereHidesNobodyBehindIt) {
  const std::array nothing{manoeuvre::doing_nothing};
  const auto told = [&](const Scene& scene) {
    const JointMotion stands = all_going_on(scene);
    return PreparedMotions(scene, {&stands, 1}, rolling()).harms(nothing)[0];
  };
  const Scene alone = behind_a_car(30.0, 0.0);
  const auto with = [&](std::initializer_list<double> ghosts) {
    Scene scene = alone;
    double before = 6.0;
    for (const double existence : ghosts) {
      world::Actor ghost = alone.actors[0];
      ghost.id = static_cast<std::uint8_t>(scene.actors.size() + 1);
      ghost.X_WA.p.x -= before;
      ghost.existence = existence;
      scene.actors.push_back(ghost);
      before += 6.0;
    }
    return scene;
  };
  const double behind = told(alone).harm;
  const double sure = told(with({1.0})).harm;
  const double both_sure = told(with({1.0, 1.0})).harm;
  ASSERT_GT(behind, 0.0);
  EXPECT_NEAR(told(with({0.05})).harm, 0.05 * sure + 0.95 * behind, 1e-9);
  EXPECT_NEAR(told(with({0.05})).contact, 1.0, 1e-12);
  Scene all_doubted = with({0.05});
  all_doubted.actors[0].existence = 0.5;
  EXPECT_NEAR(told(all_doubted).contact, 0.05 + 0.95 * 0.5, 1e-12);
  const double second_first = told(with({1.0})).harm;
  EXPECT_NEAR(told(with({1.0, 0.1})).harm, 0.1 * both_sure + 0.9 * second_first, 1e-9);
}

TEST(ExpectedHarm, AnEmptySceneHasOneMotionAndNobodyIsHarmed) {
  Scene scene = behind_a_car(14.0, 0.0);
  scene.actors.clear();
  const auto motions = joint_motions(scene, {}, intent::MotionLaw{});
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_EQ(motions[0].probability, 1.0);
  const auto all = expected_harms(scene, motions, rolling(), Physics::rolled_out);
  EXPECT_EQ(of(all, PolicyId::aeb).harm, 0.0);
  EXPECT_EQ(least_harmful(all).policy, PolicyId::no_intervention);  // all alike: the mildest
}

TEST(ExpectedHarm, JointMotionsAreProbabilitiesAndAsManyAsAskedFor) {
  Scene scene = behind_a_car(20.0, 10.0);
  scene.actors.push_back(test::car(2, {10.0, 3.5}, {12.0, 0.0}));
  intent::Beliefs beliefs;
  for (std::size_t i = 0; i < 2; ++i) {
    beliefs.push_back({});
    beliefs[i].at[0] = {0.5, 0.2, 0.1, 0.2, 0.0, 0.0, 0.0, 0.0};
  }
  const auto motions = joint_motions(scene, beliefs, intent::MotionLaw{}, 5);
  ASSERT_EQ(motions.size(), 5U);
  double sum = 0.0;
  for (const JointMotion& motion : motions) {
    EXPECT_EQ(motion.tracks.size(), 2U);
    sum += motion.probability;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_GT(motions[0].probability, motions[4].probability);
  EXPECT_THROW((void)joint_motions(scene, {}, intent::MotionLaw{}), ContractViolation);
}

// 17 m/s lies outside the small atlas, where lane changes can still be driven.
TEST(ExpectedHarm, WhereTheAtlasEndsAllIsRolledOut) {
  Scene scene = behind_a_car(14.0, 0.0);
  scene.ego.v_B.x = 17.0;
  const JointMotion stands = all_going_on(scene);
  const auto read = expected_harms(scene, {&stands, 1}, reading(), Physics::atlas);
  const auto rolled = expected_harms(scene, {&stands, 1}, rolling(), Physics::rolled_out);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].harm, rolled[i].harm);
  }
}

TEST(ExpectedHarm, WhatCannotBeDrivenIsNotChosen) {
  Scene scene = behind_a_car(1.0, 0.0);
  scene.ego.v_B.x = 4.0;  // below the domain of lane changes and drifts
  const JointMotion stands = all_going_on(scene);
  const auto all = expected_harms(scene, {&stands, 1}, rolling(), Physics::rolled_out);
  EXPECT_FALSE(of(all, PolicyId::aes_left).refusal.empty());
  EXPECT_EQ(least_harmful(all).policy, PolicyId::aeb);
}

}  // namespace
}  // namespace saca::preview::expected_harm_test

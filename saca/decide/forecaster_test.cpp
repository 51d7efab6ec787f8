#include "saca/decide/forecaster.h"

#include <gtest/gtest.h>

#include "saca/core/contract.h"
#include "saca/intent/shipped_model.h"
#include "saca/manoeuvre/batch.h"
#include "saca/manoeuvre/default_car.h"
#include "tests/support/scenes.h"

namespace saca::decide::forecaster_test {
namespace {

using manoeuvre::PolicyId;
using world::Scene;

class ForecasterTest : public ::testing::Test {
 protected:
  [[nodiscard]] Verdict judge(const Scene& scene,
                              const std::optional<UnderWay>& under_way = std::nullopt) const {
    return forecaster_.judge(scene, intent::beliefs_at_sight(intent::shipped_model(), scene),
                             under_way);
  }
  static const JudgedPlan& of(const Verdict& verdict, PolicyId policy) {
    return *find_plan(verdict, {policy, std::nullopt});
  }
  /// 15 m/s, a free lane to the left.
  static Scene road() {
    Scene scene = test::ego_at(15.0);
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -1.75;
    return scene;
  }
  /// A wreck 1.2 s ahead: 18 m for the bumper, which is too little to stop from 15 m/s by full
  /// braking.
  static Scene wreck_ahead() {
    Scene scene = road();
    scene.actors.push_back(test::car(1, {18.0 - 7.0, 0.0}));
    scene.actors[0].kind = world::ActorKind::obstacle;
    return scene;
  }

  manoeuvre::Car car_ = manoeuvre::default_car();
  outcome::HarmModel harm_ = outcome::read_harm("data/harm.toml").value();
  Forecaster forecaster_{{.car = &car_, .harm = &harm_}};
};

TEST_F(ForecasterTest, AnEmptyRoadNeedsNothing) {
  const Verdict verdict = judge(road());
  EXPECT_EQ(verdict.plans.size(), 14U);
  EXPECT_EQ(of(verdict, PolicyId::no_intervention).contact, 0.0);
  EXPECT_EQ(plan_of(verdict).policy, PolicyId::no_intervention);
  EXPECT_EQ(verdict.under_way.has_value(), false);
}

// 15 m/s against a wreck 6 m ahead of the bumper: 0.4 s. Whatever brakes, hits; nobody swerves in
// 0.4 s.
TEST_F(ForecasterTest, TellsOfContactsThatCannotBeAvoided) {
  const Verdict verdict = judge(wreck_ahead());
  EXPECT_DOUBLE_EQ(of(verdict, PolicyId::no_intervention).contact, 1.0);
  EXPECT_DOUBLE_EQ(of(verdict, PolicyId::aeb).contact, 1.0);
  EXPECT_GT(of(verdict, PolicyId::no_intervention).harm, of(verdict, PolicyId::aeb).harm);
}

TEST_F(ForecasterTest, WhatCannotBeDrivenSaysSo) {
  Scene slow = road();
  slow.ego.v_B = {3.0, 0.0};
  const Verdict verdict = judge(slow);
  EXPECT_FALSE(of(verdict, PolicyId::aes_left).drivable);
  EXPECT_TRUE(of(verdict, PolicyId::aeb).drivable);
}

// The rest of a lane change, looked at from half of it: a wreck in the lane that is left is passed,
// one in the lane that is taken is not. Beginning anew from there could not tell the two apart.
TEST_F(ForecasterTest, JudgesTheRestOfWhatIsUnderWay) {
  const Scene start = road();
  const manoeuvre::Plan swerve{PolicyId::aes_left, std::nullopt};
  const manoeuvre::Drive drive{.car = &car_,
                               .plan = swerve,
                               .ego = start.ego,
                               .road = start.road,
                               .known_grip = start.grip,
                               .grip = start.grip,
                               .unknown = {}};
  const manoeuvre::EgoMotion way = manoeuvre::drive_all({&drive, 1}, 10.0).front();
  constexpr std::size_t half = 100;  // 1 s
  Scene now = start;
  now.time = 1.0;
  now.ego = {.X_WB = way.track.X_WA[half],
             .v_B = way.v_B[half],
             .yaw_rate = way.yaw_rate[half],
             .a_B = {}};
  const UnderWay under_way{
      .plan = swerve, .begun = 0.0, .ego = start.ego, .road = start.road, .grip = start.grip};
  Scene left_behind = now;
  left_behind.actors.push_back(test::car(1, {now.ego.X_WB.p.x + 25.0, 0.0}));
  left_behind.actors[0].kind = world::ActorKind::obstacle;
  Scene in_the_way = left_behind;
  in_the_way.actors[0].X_WA.p.y = 3.5;
  EXPECT_EQ(judge(left_behind, under_way).under_way->contact, 0.0);
  EXPECT_EQ(judge(in_the_way, under_way).under_way->contact, 1.0);
  // Half a metre off its way, it comes back onto it: the same.
  left_behind.ego.X_WB.p.y -= 0.2;
  EXPECT_EQ(judge(left_behind, under_way).under_way->contact, 0.0);
}

// Braking that harms little is left for nothing but giving the wheel back: no more is judged, and
// what is judged is the same.
TEST_F(ForecasterTest, WhileBrakingDoesLittleHarmOnlyDoingNothingIsJudgedBesideIt) {
  Scene far = road();
  far.actors.push_back(test::car(1, {60.0, 0.0}));
  const auto braking = [](const Scene& scene) {
    return UnderWay{.plan = manoeuvre::full_braking,
                    .begun = scene.time - 0.2,
                    .ego = scene.ego,
                    .road = scene.road,
                    .grip = scene.grip};
  };
  const Verdict some = judge(far, braking(far));
  const Verdict all = judge(far);
  ASSERT_EQ(some.plans.size(), 2U);
  for (const PolicyId policy : {PolicyId::aeb, PolicyId::no_intervention}) {
    EXPECT_EQ(of(some, policy).harm, of(all, policy).harm);
    EXPECT_EQ(of(some, policy).contact, of(all, policy).contact);
  }
  EXPECT_EQ(plan_of(some).policy, plan_of(all).policy);
  // Braking into the wreck does harm: everything is judged.
  const Scene near = wreck_ahead();
  ASSERT_GE(of(judge(near), PolicyId::aeb).harm, material_harm);
  EXPECT_EQ(judge(near, braking(near)).plans.size(), 14U);
}

TEST_F(ForecasterTest, SameSceneSameVerdict) {
  const Scene scene = wreck_ahead();
  const Verdict a = judge(scene);
  const Verdict b = judge(scene);
  for (std::size_t i = 0; i < a.plans.size(); ++i) {
    EXPECT_EQ(a.plans[i].harm, b.plans[i].harm);
  }
}

TEST_F(ForecasterTest, RefusesBeliefsAboutOthers) {
  EXPECT_THROW((void)forecaster_.judge(wreck_ahead(), {}), ContractViolation);
  EXPECT_THROW(Forecaster({.car = &car_, .harm = &harm_}, 0), ContractViolation);
}

}  // namespace
}  // namespace saca::decide::forecaster_test

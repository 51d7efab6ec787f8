#include "saca/thinking/arbitration/forecaster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/supposed.h"
#include "saca/thinking/rollout/batch.h"
#include "tests/support/scenes.h"

namespace saca::arbitration::forecaster_test {
namespace {

using manoeuvre::PolicyId;
using world::CueKind;
using world::Scene;

class ForecasterTest : public ::testing::Test {
 protected:
  [[nodiscard]] reflex::Verdict judge(
      const Scene& scene, const std::optional<reflex::UnderWay>& under_way = std::nullopt) const {
    return forecaster_.judge(scene, intent::beliefs_at_sight(intent::shipped_model(), scene),
                             under_way);
  }
  static const reflex::JudgedPlan& of(const reflex::Verdict& verdict, PolicyId policy) {
    return *reflex::find_plan(verdict, {policy, std::nullopt});
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

  static reflex::UnderWay braking_in(const Scene& scene, const manoeuvre::Plan& plan) {
    return {.plan = plan,
            .begun = scene.time - 0.2,
            .ego = scene.ego,
            .road = scene.road,
            .grip = scene.grip};
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  Forecaster forecaster_{{.car = &car_, .harm = &harm_}};
};

TEST_F(ForecasterTest, AnEmptyRoadNeedsNothing) {
  const reflex::Verdict verdict = judge(road());
  EXPECT_EQ(verdict.plans.size(), 18U);  // eight policies, 2 x 3 more speeds, 4 more strengths
  EXPECT_EQ(of(verdict, PolicyId::no_intervention).contact, 0.0);
  EXPECT_EQ(reflex::plan_of(verdict).policy, PolicyId::no_intervention);
  EXPECT_EQ(verdict.under_way.has_value(), false);
}

// 15 m/s against a wreck 6 m ahead of the bumper: 0.4 s. Whatever brakes, hits; nobody swerves in
// 0.4 s.
TEST_F(ForecasterTest, TellsOfContactsThatCannotBeAvoided) {
  const reflex::Verdict verdict = judge(wreck_ahead());
  EXPECT_DOUBLE_EQ(of(verdict, PolicyId::no_intervention).contact, 1.0);
  EXPECT_DOUBLE_EQ(of(verdict, PolicyId::aeb).contact, 1.0);
  EXPECT_GT(of(verdict, PolicyId::no_intervention).harm, of(verdict, PolicyId::aeb).harm);
}

// A wreck in a lane between barriers. From 15 m/s the brakes need 15^2 / (2 * 0.9 * 9.81) =
// 12.7 m and what passes until they grip, some 1.5 m; begun two looks later they need 3 m more.
TEST_F(ForecasterTest, ToWaitCostsWhereBrakingHasToBeginNow) {
  const auto cost = [&](double gap) {
    Scene scene = wreck_ahead();
    scene.road.left_edge = 1.75;
    scene.road.left_beyond = scene.road.right_beyond = world::Beyond::barrier;
    const double front = scene.ego_footprint.centre_x + 0.5 * scene.ego_footprint.length;
    scene.actors[0].X_WA.p.x =
        front + gap + 0.5 * scene.actors[0].footprint.length - scene.actors[0].footprint.centre_x;
    return reflex::cost_of_waiting(judge(scene)).value();
  };
  EXPECT_EQ(cost(60.0), 0.0) << "there is time";
  EXPECT_EQ(cost(20.0), 0.0) << "the brakes stop two looks later, too";
  EXPECT_GT(cost(14.5), 0.0) << "they stop now at best";
  EXPECT_GT(cost(10.0), 0.0) << "they hit, and faster two looks later";
}

TEST_F(ForecasterTest, WhileAPlanIsUnderWayNothingWaits) {
  const Scene scene = wreck_ahead();
  EXPECT_EQ(judge(scene, braking_in(scene, manoeuvre::full_braking)).later, std::nullopt);
  EXPECT_EQ(judge(road()).later, 0.0);
}

TEST_F(ForecasterTest, WhatCannotBeDrivenSaysSo) {
  Scene slow = road();
  slow.ego.v_B = {3.0, 0.0};
  const reflex::Verdict verdict = judge(slow);
  EXPECT_FALSE(of(verdict, PolicyId::aes_left).drivable);
  EXPECT_TRUE(of(verdict, PolicyId::aeb).drivable);
}

// The rest of a lane change, looked at from half of it: a wreck in the lane that is left is passed,
// one in the lane that is taken is not. Beginning anew from there could not tell the two apart.
TEST_F(ForecasterTest, JudgesTheRestOfWhatIsUnderWay) {
  const Scene start = road();
  const manoeuvre::Plan swerve{PolicyId::aes_left, std::nullopt};
  const rollout::Drive drive{.car = &car_,
                             .plan = swerve,
                             .ego = start.ego,
                             .road = start.road,
                             .known_grip = start.grip,
                             .grip = start.grip,
                             .perturbation = {}};
  const manoeuvre::EgoMotion way = rollout::drive_all({&drive, 1}, 10.0).front();
  constexpr std::size_t half = 100;  // 1 s
  Scene now = start;
  now.time = 1.0;
  now.ego = {.X_WB = way.track.X_WA[half],
             .v_B = way.v_B[half],
             .yaw_rate = way.yaw_rate[half],
             .a_B = {}};
  const reflex::UnderWay under_way{
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
  const reflex::Verdict some = judge(far, braking_in(far, manoeuvre::full_braking));
  const reflex::Verdict all = judge(far);
  ASSERT_EQ(some.plans.size(), 2U);
  for (const PolicyId policy : {PolicyId::aeb, PolicyId::no_intervention}) {
    EXPECT_EQ(of(some, policy).harm, of(all, policy).harm);
    EXPECT_EQ(of(some, policy).contact, of(all, policy).contact);
  }
  EXPECT_EQ(reflex::plan_of(some).policy, reflex::plan_of(all).policy);
  // Braking into the wreck does harm: everything is judged.
  const Scene near = wreck_ahead();
  ASSERT_GE(of(judge(near), PolicyId::aeb).harm, reflex::material_harm);
  EXPECT_EQ(judge(near, braking_in(near, manoeuvre::full_braking)).plans.size(), 18U);
}

// What may take its place at once, harder braking, is told with it, and as without a plan under
// way; so is the next gentler one, which its own harm depends on.
TEST_F(ForecasterTest, WhileGentleBrakingDoesLittleHarmHarderBrakingIsJudgedBesideIt) {
  const manoeuvre::Plan gentle{.policy = PolicyId::aeb, .strength = 0.6};
  Scene far = road();
  far.actors.push_back(test::car(1, {80.0, 0.0}));
  far.actors[0].kind = world::ActorKind::obstacle;
  ASSERT_EQ(judge(far, braking_in(far, gentle)).plans.size(), 5U) << "full, 0.8, 0.6, 0.45, none";
  // From 15 m/s 0.6 of the grip stops within some 24 m; what is a little nearer is met slowly.
  bool found = false;
  for (double gap = 20.0; gap < 30.0 && !found; gap += 0.25) {
    Scene near = far;
    near.actors[0].X_WA.p.x = gap + 4.5;
    const reflex::Verdict all = judge(near);
    const double harm = reflex::find_plan(all, gentle)->harm;
    if (harm <= 1e-4 || harm >= reflex::material_harm) {
      continue;
    }
    found = true;
    const reflex::Verdict some = judge(near, braking_in(near, gentle));
    ASSERT_EQ(some.plans.size(), 5U);
    for (const double strength : {1.0, 0.8, 0.6}) {
      const manoeuvre::Plan plan{.policy = PolicyId::aeb, .strength = strength};
      EXPECT_EQ(reflex::find_plan(some, plan)->harm, reflex::find_plan(all, plan)->harm)
          << strength;
    }
    EXPECT_EQ(reflex::best_braking(some)->plan, reflex::best_braking(all)->plan);
  }
  EXPECT_TRUE(found);
}

// Who follows a car length behind at the same speed needs time that full braking takes from it.
TEST_F(ForecasterTest, WhoFollowsGainsByGentlerBraking) {
  Scene scene = road();
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  scene.actors[0].kind = world::ActorKind::obstacle;
  scene.actors.push_back(test::car(2, {-10.0, 0.0}, {15.0, 0.0}));
  const reflex::Verdict verdict = judge(scene);
  const manoeuvre::Plan gentle{.policy = PolicyId::aeb, .strength = 0.45};
  EXPECT_LT(reflex::find_plan(verdict, gentle)->harm,
            reflex::find_plan(verdict, manoeuvre::full_braking)->harm);
  EXPECT_LT(strength_of(reflex::best_braking(verdict)->plan), 1.0);
}

TEST_F(ForecasterTest, SameSceneSameVerdict) {
  const Scene scene = wreck_ahead();
  const reflex::Verdict a = judge(scene);
  const reflex::Verdict b = judge(scene);
  for (std::size_t i = 0; i < a.plans.size(); ++i) {
    EXPECT_EQ(a.plans[i].harm, b.plans[i].harm);
  }
}

void expect_usable(const reflex::Verdict& verdict) {
  for (const reflex::JudgedPlan& one : verdict.plans) {
    EXPECT_TRUE(std::isfinite(one.harm) && one.harm >= 0.0);
    EXPECT_TRUE(one.contact >= 0.0 && one.contact <= 1.0);
  }
}

// A tracker that says it knows everything, and one that knows nothing: 100 m and 100 m/s.
TEST_F(ForecasterTest, JudgesWithAllErrorsNoneOrHuge) {
  Scene scene = wreck_ahead();
  scene.actors.push_back(test::car(2, {30.0, 3.5}, {10.0, 0.3}));
  scene.actors.push_back(test::car(3, {-20.0, 0.0}, {16.0, 0.0}));
  for (const double sd : {0.0, 100.0}) {
    for (world::Actor& actor : scene.actors) {
      actor.position_sd = sd;
      actor.velocity_sd = sd;
    }
    scene.grip_sd = sd > 0.0 ? 0.5 : 0.0;
    expect_usable(judge(scene));
  }
}

// 32 cars about, each as likely to do one thing as another: still so many draws, not so many
// combinations.
TEST_F(ForecasterTest, JudgesAllWhoMayDoAnything) {
  Scene scene = test::ego_at(15.0);
  scene.road.left_edge = 12.0;
  scene.road.right_edge = -12.0;
  intent::Beliefs beliefs;
  intent::Belief anything;
  for (intent::IntentPosterior& posterior : anything.at) {
    posterior.fill(0.0);
    for (const intent::Intention one : intent::vehicle_intentions) {
      posterior[static_cast<std::size_t>(one)] = 1.0 / intent::vehicle_intentions.size();
    }
  }
  for (std::size_t i = 0; i < world::max_actors; ++i) {
    const double ahead = -40.0 + 12.0 * static_cast<double>(i / 4);
    const double left = -7.0 + 4.0 * static_cast<double>(i % 4);
    scene.actors.push_back(test::car(static_cast<std::uint8_t>(i + 1), {ahead, left}, {14.0, 0.2}));
    beliefs.push_back(anything);
  }
  const reflex::Verdict verdict = forecaster_.judge(scene, beliefs);
  expect_usable(verdict);
  EXPECT_GT(of(verdict, PolicyId::no_intervention).contact, 0.0);
  EXPECT_EQ(draws_of(scene, beliefs).size(), usual_draws);
}

TEST_F(ForecasterTest, RefusesBeliefsAboutOthers) {
  EXPECT_THROW((void)forecaster_.judge(wreck_ahead(), {}), ContractViolation);
  EXPECT_THROW(Forecaster({.car = &car_, .harm = &harm_}, 0), ContractViolation);
}

// ---- What cues stand for

class CuesTest : public ::testing::Test {
 protected:
  CuesTest() {
    law_.unseen[static_cast<std::size_t>(CueKind::bus_at_stop)] =
        intent::Unseen{.who = world::ActorKind::pedestrian, .probability = 0.4, .speed = 2.0};
    law_.unseen[static_cast<std::size_t>(CueKind::wet_leaves)] =
        intent::Unseen{.who = std::nullopt, .probability = 0.5, .grip_share = 0.4};
  }
  [[nodiscard]] reflex::Verdict seen(const Scene& scene) const {
    return forecaster_.judge(scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
  }
  [[nodiscard]] reflex::Verdict by_cues(const Scene& scene) const {
    return reckoning_.judge(scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
  }
  static double harm_of(const reflex::Verdict& verdict, PolicyId policy) {
    return reflex::find_plan(verdict, {policy, std::nullopt})->harm;
  }
  /// 15 m/s, three lanes; a wreck ahead in ours.
  static Scene wreck_between_lanes() {
    Scene scene = test::ego_at(15.0);
    scene.road.left_edge = 5.25;
    scene.road.right_edge = -5.25;
    scene.actors.push_back(test::car(1, {22.0, 0.0}));
    scene.actors[0].kind = world::ActorKind::obstacle;
    return scene;
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  intent::CueLaw law_;
  Forecaster forecaster_{{.car = &car_, .harm = &harm_}};
  Forecaster reckoning_{{.car = &car_, .harm = &harm_, .cues = &law_}};
};

TEST_F(CuesTest, WithoutCuesNothingChanges) {
  const Scene scene = wreck_between_lanes();
  const reflex::Verdict plain = seen(scene);
  const reflex::Verdict judged = by_cues(scene);
  ASSERT_EQ(judged.plans.size(), plain.plans.size());
  for (std::size_t i = 0; i < plain.plans.size(); ++i) {
    EXPECT_EQ(judged.plans[i].harm, plain.plans[i].harm);
    EXPECT_FALSE(judged.plans[i].as_seen);
  }
}

// Nobody threatens: somebody may step out, but nobody takes the wheel for that.
TEST_F(CuesTest, ACueAloneTakesNoWheel) {
  Scene scene = wreck_between_lanes();
  scene.actors.clear();
  scene.cues.push_back({CueKind::bus_at_stop, {15.0, -4.0}});
  const reflex::Verdict judged = by_cues(scene);
  EXPECT_EQ(reflex::plan_of(judged), manoeuvre::doing_nothing);
  EXPECT_EQ(harm_of(judged, PolicyId::no_intervention), 0.0);
}

TEST_F(CuesTest, EachCueThatCountsIsJudgedByItself) {
  Scene scene = wreck_between_lanes();
  const intent::Beliefs beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
  EXPECT_EQ(judgements_of(scene, beliefs, &law_), 1.0);
  scene.cues.push_back({CueKind::bus_at_stop, {24.0, -3.0}});
  EXPECT_EQ(judgements_of(scene, beliefs, nullptr), 1.0);
  EXPECT_DOUBLE_EQ(judgements_of(scene, beliefs, &law_), 1.6);
  scene.cues.push_back({CueKind::wet_leaves, {24.0, 0.0}});
  EXPECT_DOUBLE_EQ(judgements_of(scene, beliefs, &law_), 2.2);
  scene.cues[1].p_W.x = -100.0;  // we have passed them long ago
  EXPECT_DOUBLE_EQ(judgements_of(scene, beliefs, &law_), 1.6);
}

// Somebody steps out before the wreck, or it is slippery. That he is met does not undo that the
// wreck is hit where he does not come: the harm is the mean over all worlds.
TEST_F(CuesTest, WhatComesOfAPlanIsTheMeanOverAllWorlds) {
  Scene scene = wreck_between_lanes();
  scene.cues.push_back({CueKind::bus_at_stop, {17.0, -3.0}});
  scene.cues.push_back({CueKind::wet_leaves, {24.0, 0.0}});
  const intent::Beliefs beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
  const preview::Suppositions all = preview::suppositions(scene, beliefs, law_);
  ASSERT_EQ(all.size(), 2U);
  const reflex::Verdict plain = seen(scene);
  const reflex::Verdict judged = by_cues(scene);
  const auto by_half = [&](const Scene& world, const intent::Beliefs& believed, PolicyId policy) {
    auto draws = draws_of(world, believed);
    draws.resize(usual_draws / 2);
    const manoeuvre::Plan plan{policy, std::nullopt};
    const preview::ForecastTools tools{.car = &car_, .harm = &harm_};
    return preview::PreparedMotions(world, draws, tools).harms({&plan, 1}).front().harm;
  };
  for (const PolicyId policy : {PolicyId::no_intervention, PolicyId::aeb, PolicyId::aes_right}) {
    double mean = harm_of(plain, policy);
    for (const preview::Supposition& one : all) {
      mean += one.probability *
              (by_half(one.scene, one.beliefs, policy) - by_half(scene, beliefs, policy));
    }
    EXPECT_NEAR(harm_of(judged, policy), mean, 1e-12);
  }
  EXPECT_GT(harm_of(judged, PolicyId::no_intervention), harm_of(plain, PolicyId::no_intervention));
}

// Full braking under way, and a wreck that it just spares: as seen nothing is better. Where it may
// be slippery all plans are judged, and the braking harms more.
TEST_F(CuesTest, WhatIsUnderWayIsJudgedInAllWorlds) {
  Scene scene = wreck_between_lanes();
  scene.cues.push_back({CueKind::wet_leaves, {24.0, 0.0}});
  const reflex::UnderWay braking = {.plan = manoeuvre::full_braking,
                                    .begun = scene.time,
                                    .ego = scene.ego,
                                    .road = scene.road,
                                    .grip = scene.grip};
  const intent::Beliefs beliefs = intent::beliefs_at_sight(intent::shipped_model(), scene);
  const reflex::Verdict plain = forecaster_.judge(scene, beliefs, braking);
  ASSERT_LT(harm_of(plain, PolicyId::aeb), reflex::material_harm);
  const reflex::Verdict judged = reckoning_.judge(scene, beliefs, braking);
  EXPECT_GT(judged.plans.size(), plain.plans.size());
  EXPECT_GT(harm_of(judged, PolicyId::aeb), harm_of(plain, PolicyId::aeb));
  const reflex::UnderWay swerve = {.plan = {PolicyId::aes_left, std::nullopt},
                                   .begun = scene.time,
                                   .ego = scene.ego,
                                   .road = scene.road,
                                   .grip = scene.grip};
  const reflex::Verdict of_swerve = reckoning_.judge(scene, beliefs, swerve);
  ASSERT_TRUE(of_swerve.under_way);
  EXPECT_EQ(of_swerve.under_way->harm, of_swerve.under_way->as_seen);
}

// Somebody who comes from the right beside the wreck is met by who goes there.
TEST_F(CuesTest, TheSideOfTheCueHarmsMore) {
  Scene scene = wreck_between_lanes();
  scene.cues.push_back({CueKind::bus_at_stop, {24.0, -4.0}});
  const reflex::Verdict plain = seen(scene);
  const reflex::Verdict judged = by_cues(scene);
  const auto added = [&](PolicyId policy) {
    return harm_of(judged, policy) - harm_of(plain, policy);
  };
  EXPECT_GT(added(PolicyId::aes_right), 0.01);
  EXPECT_GT(added(PolicyId::aes_right), added(PolicyId::aeb));
  const reflex::JudgedPlan* right = reflex::find_plan(judged, {PolicyId::aes_right, std::nullopt});
  ASSERT_TRUE(right->as_seen);
  EXPECT_DOUBLE_EQ(*right->as_seen, harm_of(plain, PolicyId::aes_right));
}

TEST_F(CuesTest, WaitingCostsAsMuchAsWithoutCues) {
  Scene scene = wreck_between_lanes();
  scene.cues.push_back({CueKind::bus_at_stop, {24.0, -4.0}});
  const auto without = reflex::cost_of_waiting(seen(scene));
  const auto with = reflex::cost_of_waiting(by_cues(scene));
  ASSERT_TRUE(without && with);
  EXPECT_NEAR(*with, *without, 1e-12);
}

// A patch of leaves that takes no grip says nothing of a wreck whose place is known to half a
// metre: by other draws it would be met more or less often.
TEST_F(CuesTest, WhatASuppositionDoesNotTouchHarmsAsItDid) {
  law_.unseen[static_cast<std::size_t>(CueKind::wet_leaves)]->grip_share = 1.0;
  Scene scene = wreck_between_lanes();
  scene.actors[0].position_sd = 0.5;
  const reflex::Verdict plain = seen(scene);
  scene.cues.push_back({CueKind::wet_leaves, {24.0, 0.0}});
  const reflex::Verdict judged = by_cues(scene);
  ASSERT_EQ(judged.plans.size(), plain.plans.size());
  for (std::size_t i = 0; i < plain.plans.size(); ++i) {
    EXPECT_DOUBLE_EQ(judged.plans[i].harm, plain.plans[i].harm);
  }
}

// With half of the probability on 0.4 of the grip, braking harms the mean of both: a wreck is the
// same in every draw.
TEST_F(CuesTest, LessGripCountsAsItsProbability) {
  Scene scene = wreck_between_lanes();
  scene.cues.push_back({CueKind::wet_leaves, {10.0, 0.0}});
  Scene slippery = wreck_between_lanes();
  slippery.grip *= 0.4;
  const double dry = harm_of(seen(scene), PolicyId::aeb);
  const double wet = harm_of(seen(slippery), PolicyId::aeb);
  EXPECT_GT(wet, dry);
  EXPECT_NEAR(harm_of(by_cues(scene), PolicyId::aeb), 0.5 * (dry + wet), 1e-12);
}

}  // namespace
}  // namespace saca::arbitration::forecaster_test

#include "saca/onboard/reflex/reflex_plane.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/reflex/verdict_for_test.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"
#include "tests/support/system_calls.h"

namespace saca::reflex::reflex_plane_test {
namespace {

using manoeuvre::PolicyId;
using test::car;
using world::Scene;

Scene motorway(double speed) {
  Scene scene = test::ego_at(speed, {.length = 4.7, .width = 1.9, .centre_x = -0.1});
  scene.road.left_edge = 8.75;
  return scene;
}

/// A wreck that the ego reaches after `time` at 20 m/s: half a wreck and the ego's front lie
/// between.
Scene wreck_in(double time) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {20.0 * time + 4.5, 0.0}));
  return scene;
}

PlanCache one_plan(const Scene& scene_at_trigger, PolicyId policy, bool worse = false) {
  PlanCache cache;
  cache.push_back({.at_trigger = match::features(scene_at_trigger),
                   .trigger = scene_at_trigger.time,
                   .plan = {policy, std::nullopt},
                   .source = Source::model,
                   .worse_than_aeb = worse,
                   .preview = 3});
  return cache;
}

TEST(ReflexPlane, DoesNothingBeforeTheTrigger) {
  ReflexPlane plane{ReflexTools{}};
  const Reflex reflex = plane.step(wreck_in(1.4));
  EXPECT_FALSE(reflex.triggered);
  EXPECT_EQ(reflex.plan.policy, PolicyId::no_intervention);
  EXPECT_NEAR(reflex.threat->time, 1.4, 0.011);
  EXPECT_EQ(plane.decision(), std::nullopt);
}

// 25.6 m at 20 m/s: the driver needs 7.8 m/s^2 and brakes with 9, until he lets go.
TEST(ReflexPlane, LeavesADriverAloneWhoBrakesEnough) {
  ReflexPlane plane{ReflexTools{}};
  Scene braking = wreck_in(1.28);
  braking.ego.a_B = {-9.0, 0.0};
  EXPECT_FALSE(plane.needs_verdict(braking, false));
  const Reflex reflex = plane.step(braking);
  EXPECT_FALSE(reflex.triggered);
  EXPECT_NEAR(reflex.threat->time, 1.28, 0.011) << "who lets go is in conflict";
  EXPECT_TRUE(plane.step(wreck_in(1.27)).triggered);
}

/// 20 m/s and 20 m to somebody who was not there before.
Scene appeared(double time) {
  Scene scene = wreck_in(1.0);
  scene.time = time;
  return scene;
}
Scene nobody(double time) {
  Scene scene = motorway(20.0);
  scene.time = time;
  return scene;
}

TEST(ReflexPlane, ASingleLookAtSomebodyIsNoTrigger) {
  ReflexPlane plane{ReflexTools{}};
  EXPECT_FALSE(plane.step(nobody(0.0)).triggered);
  EXPECT_FALSE(plane.needs_verdict(appeared(0.01), false));
  const Reflex ghost = plane.step(appeared(0.01));
  EXPECT_FALSE(ghost.triggered);
  EXPECT_NEAR(ghost.threat->time, 1.0, 0.011) << "it is in conflict all the same";
  for (int k = 2; k <= 10; ++k) {
    EXPECT_FALSE(plane.step(nobody(0.01 * k)).triggered);
  }
}

TEST(ReflexPlane, TwoLooksOfThreeAre) {
  for (const bool misses_one : {false, true}) {
    ReflexPlane plane{ReflexTools{}};
    (void)plane.step(nobody(0.0));
    (void)plane.step(appeared(0.01));
    if (misses_one) {
      EXPECT_FALSE(plane.step(nobody(0.02)).triggered);
    }
    EXPECT_TRUE(plane.needs_verdict(appeared(0.03), false));
    EXPECT_TRUE(plane.step(appeared(0.03)).triggered);
  }
}

TEST(ReflexPlane, ABrokenSceneIsNoLook) {
  ReflexPlane plane{ReflexTools{}};
  (void)plane.step(nobody(0.0));
  Scene broken = appeared(0.005);
  broken.actors[0].v_W.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(plane.step(broken).refused_scene);
  EXPECT_FALSE(plane.step(appeared(0.01)).triggered);
  EXPECT_TRUE(plane.step(appeared(0.02)).triggered);
}

/// Braking now harms nobody, begun later by so much.
Verdict waiting_costs(double time, double harm) {
  Verdict verdict = verdict_of(time, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.3}});
  verdict.later = harm;
  return verdict;
}

/// A tenth of a second after a look at the same scene with the same verdict.
Reflex step_again(ReflexPlane& plane, const Scene& scene, const Verdict& verdict) {
  Scene before = scene;
  before.time -= look_ahead;
  Verdict first = verdict;
  first.time -= look_ahead;
  plane.receive(first);
  EXPECT_FALSE(plane.step(before).triggered) << "one verdict may err";
  plane.receive(verdict);
  return plane.step(scene);
}

TEST(ReflexPlane, ActsBeforeT1WhereWaitingCostsTooMuch) {
  const auto step = [](double cost, double time, ReflexTools tools) {
    const bool watches = tools.thresholds.waiting_cost && time < 5.5;
    ReflexPlane plane(std::move(tools));
    const Scene scene = wreck_in(time);
    EXPECT_EQ(plane.needs_verdict(scene, false), plane.supervises() && watches);
    const Reflex reflex = step_again(plane, scene, waiting_costs(scene.time, cost));
    EXPECT_EQ(reflex.triggered, plane.decision().has_value());
    EXPECT_EQ(reflex.plan.policy == PolicyId::aeb, reflex.triggered);
    return plane.decision();
  };
  const auto early = step(0.02, 2.4, {});
  ASSERT_TRUE(early.has_value());
  EXPECT_EQ(early->waiting_cost, 0.02);
  EXPECT_EQ(early->source, Source::arbiter);
  EXPECT_FALSE(step(0.002, 2.4, {})) << "so much is not worth it";
  EXPECT_FALSE(step(0.02, 6.0, {})) << "beyond T2";
  ReflexPlane late{ReflexTools{}};
  late.receive(waiting_costs(0.0, 0.02));
  EXPECT_TRUE(late.step(wreck_in(1.28)).triggered);
  EXPECT_EQ(late.decision()->waiting_cost, std::nullopt)
      << "at T1 it acts whatever waiting costs, and at once";
  EXPECT_FALSE(step(0.02, 2.4, {.thresholds = {.waiting_cost = std::nullopt}}));
  EXPECT_FALSE(step(0.02, 2.4, {.guard = Guard::none})) << "Algorithm 1 waits for T1";
  EXPECT_FALSE(step(0.02, 2.4, {.forced = manoeuvre::full_braking}));
}

// Braking harms 0.2 however early it begins.
TEST(ReflexPlane, LeavesTheLaneLaterThanItBrakes) {
  const auto begun = [](double time_to_conflict, double braking_harm) {
    ReflexPlane plane{ReflexTools{}};
    const Scene scene = wreck_in(time_to_conflict);
    Verdict verdict = verdict_of(scene.time, {{PolicyId::aeb, braking_harm},
                                              {PolicyId::aes_left, 0.0},
                                              {PolicyId::no_intervention, 0.3}});
    verdict.later = 0.1;
    const Reflex reflex = step_again(plane, scene, verdict);
    return reflex.triggered ? std::optional(reflex.plan.policy) : std::nullopt;
  };
  EXPECT_EQ(begun(2.4, 0.2), PolicyId::aes_left);
  EXPECT_EQ(begun(2.6, 0.2), std::nullopt) << "it may still become another scene";
  EXPECT_EQ(begun(2.6, 0.0), PolicyId::aeb) << "braking can be taken back";
}

TEST(ReflexPlane, BeforeT1NothingStandsForNothingAndStaleVerdictsDoNotCount) {
  const Scene scene = wreck_in(2.4);
  ReflexPlane idle{ReflexTools{}};
  Verdict nothing = waiting_costs(scene.time, 0.5);
  nothing.plans[0].harm = 0.4;  // going on is the least
  EXPECT_FALSE(step_again(idle, scene, nothing).triggered);
  ReflexPlane plane{ReflexTools{}};
  EXPECT_FALSE(plane.step(scene).triggered) << "without a verdict";
  Scene next = scene;
  next.time += 0.1;
  plane.receive(waiting_costs(next.time - 2.0 * verdict_expiry, 0.02));
  EXPECT_FALSE(plane.step(next).triggered);
  next.time += 0.2;
  EXPECT_TRUE(step_again(plane, next, waiting_costs(next.time, 0.02)).triggered);
}

// The same verdict looked at twice is no second opinion, and what was said a second ago is past.
TEST(ReflexPlane, BeforeT1TwoVerdictsRunningHaveToAgree) {
  const auto acts = [](double second_verdict, double second_look) {
    ReflexPlane plane{ReflexTools{}};
    Scene scene = wreck_in(2.4);
    plane.receive(waiting_costs(scene.time, 0.02));
    EXPECT_FALSE(plane.step(scene).triggered);
    scene.time = second_look;
    plane.receive(waiting_costs(second_verdict, 0.02));
    return plane.step(scene).triggered;
  };
  EXPECT_TRUE(acts(0.1, 0.1));
  EXPECT_TRUE(acts(0.1, 0.2));
  EXPECT_FALSE(acts(0.0, 0.1));
  EXPECT_FALSE(acts(1.0, 1.0));
}

// 0.02, nothing, 0.02: the one in between says that there is time.
TEST(ReflexPlane, BeforeT1AVerdictThatDisagreesIsNotPassedOver) {
  ReflexPlane plane{ReflexTools{}};
  Scene scene = wreck_in(2.4);
  for (const auto& [time, cost] : {std::pair{0.0, 0.02}, {0.1, 0.0}, {0.2, 0.02}}) {
    scene.time = time;
    plane.receive(waiting_costs(time, cost));
    EXPECT_FALSE(plane.step(scene).triggered) << time;
  }
  scene.time = 0.3;
  plane.receive(waiting_costs(0.3, 0.02));
  EXPECT_TRUE(plane.step(scene).triggered);
}

// Ten times a second at most: in between nobody has to make a verdict.
TEST(ReflexPlane, LooksAtVerdictsBeforeT1EveryTenthOfASecond) {
  ReflexPlane plane{ReflexTools{}};
  Scene scene = wreck_in(2.4);
  (void)plane.step(scene);
  scene.time += 0.05;
  EXPECT_FALSE(plane.needs_verdict(scene, false));
  scene.time += 0.05;
  EXPECT_TRUE(plane.needs_verdict(scene, false));
}

TEST(ReflexPlane, BrakesWhenNothingWasThought) {
  ReflexPlane plane{ReflexTools{}};
  const Reflex reflex = plane.step(wreck_in(1.28));
  EXPECT_TRUE(reflex.triggered);
  EXPECT_EQ(reflex.plan.policy, PolicyId::aeb);
  EXPECT_EQ(plane.decision()->source, Source::fallback);
  EXPECT_EQ(plane.decision()->similarity, std::nullopt);
}

TEST(ReflexPlane, CarriesOutThePlanOfTheSituationThatCame) {
  ReflexPlane plane{ReflexTools{}};
  plane.receive(one_plan(wreck_in(1.3), PolicyId::aes_left));
  const Reflex reflex = plane.step(wreck_in(1.29));
  EXPECT_EQ(reflex.plan.policy, PolicyId::aes_left);
  EXPECT_EQ(plane.decision()->source, Source::model);
  EXPECT_EQ(plane.decision()->preview, 3);
  EXPECT_GT(plane.decision()->similarity.value(), match_similarity);
}

TEST(ReflexPlane, HasNoUseForAPlanWhoseTriggerHasLongPassed) {
  const auto source = [](double late, Guard guard) {
    ReflexPlane plane({.guard = guard});
    Scene scene = wreck_in(1.3);
    scene.time = 5.0;
    plane.receive(one_plan(scene, PolicyId::aes_left));
    scene = wreck_in(1.29);
    scene.time = 5.0 + late;
    (void)plane.step(scene);
    return plane.decision()->source;
  };
  EXPECT_EQ(source(-0.3, Guard::never_worse_than_braking), Source::model);
  EXPECT_EQ(source(0.99, Guard::never_worse_than_braking), Source::model);
  EXPECT_EQ(source(1.01, Guard::never_worse_than_braking), Source::fallback);
  EXPECT_EQ(source(1.01, Guard::none), Source::model);
}

TEST(ReflexPlane, BrakesWhenAnotherSituationCame) {
  ReflexPlane plane{ReflexTools{}};
  Scene other = wreck_in(1.3);
  other.actors[0].kind = world::ActorKind::truck;
  other.actors[0].v_W = {0.0, -9.0};
  plane.receive(one_plan(other, PolicyId::aes_left));
  const Reflex reflex = plane.step(wreck_in(1.29));
  EXPECT_EQ(reflex.plan.policy, PolicyId::aeb);
  EXPECT_EQ(plane.decision()->source, Source::fallback);
  EXPECT_TRUE(plane.decision()->similarity.has_value());
}

TEST(ReflexPlane, IsNeverKnowinglyWorseThanBraking) {
  ReflexPlane plane{ReflexTools{}};
  plane.receive(one_plan(wreck_in(1.3), PolicyId::aes_left, true));
  EXPECT_EQ(plane.step(wreck_in(1.29)).plan.policy, PolicyId::aeb);
  EXPECT_TRUE(plane.decision()->not_admissible);
}

/// As wreck_in, slow enough for the small atlas, with a plan for it.
Scene slow_wreck_in(double time) {
  Scene scene = motorway(12.5);
  scene.actors.push_back(car(1, {12.5 * time + 4.5, 0.0}));
  return scene;
}
const manoeuvre::Car& small_car() {
  return atlas::small_atlas_car();
}
ReflexTools with_atlas() {
  static const auto harm = prepare::read_harm("data/harm.toml").value();
  return {.car = &small_car(), .atlas = AtlasJudge(small_car(), atlas::small_atlas(), harm)};
}
Decision decision_with_atlas(const Scene& scene, PolicyId policy) {
  ReflexPlane plane(with_atlas());
  plane.receive(one_plan(scene, policy));
  (void)plane.step(scene);
  return plane.decision().value();
}
double harm_of(const Decision& decision, PolicyId policy) {
  return find_plan(decision.verdict.value(), {policy, std::nullopt})->harm;
}

// Where somebody stands in the next lane, a swerve into it hits at full speed; braking from
// 12.5 m/s needs 10.2 m (docs/architecture.md: 12.70 m from 14), and there are 16.
TEST(ReflexPlane, WithoutAVerdictAsksTheAtlas) {
  Scene blocked = slow_wreck_in(1.28);
  blocked.actors.push_back(car(2, {blocked.actors[0].X_WA.p.x + 2.0, 3.5}));
  const Decision decision = decision_with_atlas(blocked, PolicyId::aes_left);
  EXPECT_EQ(decision.plan.policy, PolicyId::aeb);
  EXPECT_EQ(decision.source, Source::arbiter);
  EXPECT_TRUE(decision.not_admissible);
  EXPECT_TRUE(decision.by_atlas);
  EXPECT_GT(harm_of(decision, PolicyId::aes_left), harm_of(decision, PolicyId::aeb));
  EXPECT_EQ(harm_of(decision, PolicyId::aeb), 0.0);
}

TEST(ReflexPlane, KeepsThePlanWhereTheAtlasHasNothingAgainstIt) {
  const Decision free = decision_with_atlas(slow_wreck_in(1.28), PolicyId::aes_left);
  EXPECT_EQ(free.plan.policy, PolicyId::aes_left);
  EXPECT_EQ(free.source, Source::model);
  EXPECT_EQ(harm_of(free, PolicyId::aes_left), 0.0);
  // The small atlas does not know 20 m/s: the thinking plane's forecast stands.
  const Decision fast = decision_with_atlas(wreck_in(1.28), PolicyId::aes_left);
  EXPECT_EQ(fast.plan.policy, PolicyId::aes_left);
  EXPECT_FALSE(fast.verdict.has_value());
}

TEST(ReflexPlane, DoesWhatAFreshVerdictSpeaksFor) {
  ReflexPlane plane{ReflexTools{}};
  Scene scene = wreck_in(1.28);
  scene.time = 5.0;
  plane.receive(verdict_of(4.95, {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}}));
  EXPECT_EQ(plane.step(scene).plan.policy, PolicyId::aes_left);
  EXPECT_EQ(plane.decision()->source, Source::arbiter);
  EXPECT_FALSE(plane.decision()->by_atlas);
}

TEST(ReflexPlane, HasNoUseForAVerdictThatIsOldOrOfAnotherTime) {
  for (const double time : {4.89, 5.01}) {
    ReflexPlane plane{ReflexTools{}};
    Scene scene = wreck_in(1.28);
    scene.time = 5.0;
    plane.receive(verdict_of(time, {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}}));
    EXPECT_EQ(plane.step(scene).plan.policy, PolicyId::aeb) << time;
    EXPECT_EQ(plane.decision()->source, Source::fallback);
  }
}

TEST(ReflexPlane, PrefersTheCachedPlanWhereItIsAdmissible) {
  const auto decided = [](double harm_of_cached) {
    ReflexPlane plane{ReflexTools{}};
    Scene scene = wreck_in(1.28);
    scene.time = 5.0;
    plane.receive(one_plan(scene, PolicyId::aes_right));
    plane.receive(verdict_of(
        5.0,
        {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}, {PolicyId::aes_right, harm_of_cached}}));
    (void)plane.step(scene);
    return plane.decision().value();
  };
  EXPECT_EQ(decided(0.005).plan.policy, PolicyId::aes_right);  // within 3 % of 0.2
  EXPECT_EQ(decided(0.005).source, Source::model);
  EXPECT_EQ(decided(0.007).plan.policy, PolicyId::aes_left);
  EXPECT_TRUE(decided(0.007).not_admissible);
}

TEST(ReflexPlane, BeginsNoCachedPlanWhereDoingNothingIsAsGood) {
  const auto decided = [](double harm_of_nothing, Guard guard) {
    ReflexPlane plane{ReflexTools{.guard = guard}};
    Scene scene = wreck_in(1.28);
    scene.time = 5.0;
    plane.receive(one_plan(scene, PolicyId::aeb));
    plane.receive(
        verdict_of(5.0, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, harm_of_nothing}}));
    (void)plane.step(scene);
    return plane.decision().value();
  };
  const Decision needless = decided(0.001, Guard::never_worse_than_braking);  // within 0.002
  EXPECT_EQ(needless.plan, manoeuvre::doing_nothing);
  EXPECT_EQ(needless.source, Source::arbiter);
  EXPECT_FALSE(needless.not_admissible);
  EXPECT_TRUE(was_needless(needless));
  const Decision needed = decided(0.003, Guard::never_worse_than_braking);
  EXPECT_EQ(needed.plan, manoeuvre::full_braking);
  EXPECT_EQ(needed.source, Source::model);
  EXPECT_FALSE(was_needless(needed));
  EXPECT_EQ(decided(0.001, Guard::none).source, Source::model);  // by the paper's rule
}

// Memory and model choose policy 0, the verdict how hard; without a verdict, or by the paper's
// rule, it is full braking whatever was forecast.
TEST(ReflexPlane, BrakesAsHardAsTheVerdictSaysWhereBrakingWasChosen) {
  Scene scene = wreck_in(1.28);
  scene.time = 5.0;
  PlanCache cached = one_plan(scene, PolicyId::aeb);
  cached[0].plan.strength = 0.45;
  const auto decided = [&](Guard guard, double verdict_at) {
    ReflexPlane plane({.guard = guard});
    plane.receive(cached);
    plane.receive(braking_verdict(verdict_at, 0.05, 0.02, 0.001, 0.08));
    EXPECT_TRUE(plane.step(scene).triggered);
    return plane.decision().value();
  };
  const Decision fresh = decided(Guard::never_worse_than_braking, 5.0);
  EXPECT_EQ(fresh.plan, braking_at(0.6));
  EXPECT_EQ(fresh.source, Source::model);
  EXPECT_EQ(decided(Guard::never_worse_than_braking, 4.0).plan, manoeuvre::full_braking);
  EXPECT_EQ(decided(Guard::never_worse_than_braking, 4.0).source, Source::model);
  EXPECT_EQ(decided(Guard::none, 5.0).plan, manoeuvre::full_braking);
}

// Previewed at 24.9 m/s, triggered at 25.2: a lane change is made for at most 25.
TEST(ReflexPlane, NeverBeginsWhatCannotBeDrivenFromHere) {
  ReflexPlane plane({.car = &small_car()});
  Scene scene = motorway(25.2);
  scene.actors.push_back(car(1, {25.2 * 1.28 + 4.5, 0.0}));
  plane.receive(one_plan(scene, PolicyId::aes_left));
  EXPECT_EQ(plane.step(scene).plan.policy, PolicyId::aeb);
  EXPECT_EQ(plane.decision()->source, Source::fallback);
  EXPECT_EQ(plane.decision()->refused,
            (RefusedPlan{{PolicyId::aes_left, std::nullopt}, manoeuvre::Refusal::speed}));
}

TEST(ReflexPlane, NeverBeginsWhatTheUserAsksForAndCannotBeDriven) {
  const manoeuvre::Plan drift{PolicyId::t_drift_left, std::nullopt};
  ReflexPlane plane({.car = &small_car(), .forced = drift});
  Scene scene = wreck_in(1.28);
  scene.grip = 0.15;
  EXPECT_EQ(plane.step(scene).plan, manoeuvre::full_braking);
  EXPECT_EQ(plane.decision()->source, Source::fallback);
  EXPECT_EQ(plane.decision()->refused, (RefusedPlan{drift, manoeuvre::Refusal::grip}));
}

TEST(ReflexPlane, ByThePapersRuleNoVerdictCounts) {
  ReflexPlane plane({.guard = Guard::none});
  plane.receive(one_plan(wreck_in(1.28), PolicyId::aes_right));
  plane.receive(verdict_of(0.0, {{PolicyId::aeb, 0.0}, {PolicyId::aes_right, 0.5}}));
  EXPECT_EQ(plane.step(wreck_in(1.28)).plan.policy, PolicyId::aes_right);
  EXPECT_FALSE(plane.needs_verdict(wreck_in(1.0), false));
}

TEST(ReflexPlane, IsSupervisedFromThenOn) {
  ReflexPlane plane{ReflexTools{}};
  Scene scene = wreck_in(1.28);
  (void)plane.step(scene);
  ASSERT_EQ(plane.under_way()->plan.policy, PolicyId::aeb);
  Reflex reflex;
  for (int k = 1; k <= 2; ++k) {
    scene = wreck_in(1.28 - 0.1 * k);
    scene.time = 0.1 * k;
    EXPECT_TRUE(plane.needs_verdict(scene, false));
    plane.receive(verdict_of(scene.time, {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}}));
    reflex = plane.step(scene);
  }
  ASSERT_TRUE(reflex.switched.has_value());
  EXPECT_EQ(reflex.plan.policy, PolicyId::aes_left);
  EXPECT_EQ(plane.under_way()->plan.policy, PolicyId::aes_left);
  EXPECT_EQ(plane.under_way()->begun, 0.2);
  EXPECT_EQ(plane.decision()->plan.policy, PolicyId::aeb) << "the first stands in the record";
}

/// At 12.5 m/s; a car comes from the right at 8 m/s, 18.8 m ahead, and would have cleared the ego's
/// path 0.4 s before the ego is there, in 1.25 s; `stopped`: it stands across the lane instead.
Scene crossed_after(double time, bool stopped) {
  Scene scene = motorway(12.5);
  scene.time = time;
  scene.ego.X_WB.p.x = 12.5 * time;
  scene.actors.push_back(stopped ? car(1, {18.8, 0.0})
                                 : car(1, {18.8, -3.6 + 8.0 * time}, {0.0, 8.0}));
  scene.actors[0].X_WA.yaw = 0.5 * std::numbers::pi;
  return scene;
}

// It passes ahead, so that nothing is to be done; then it stops, and braking needs 10.2 m of 13.8.
TEST(ReflexPlane, WhereNoVerdictComesTheAtlasFindsWhatIsNeededAfterAll) {
  ReflexPlane plane(with_atlas());
  ASSERT_TRUE(plane.step(crossed_after(0.0, false)).triggered);
  ASSERT_EQ(plane.decision()->plan, manoeuvre::doing_nothing);
  ASSERT_TRUE(plane.decision()->by_atlas);
  EXPECT_FALSE(plane.step(crossed_after(0.05, false)).switched);
  const Reflex reflex = plane.step(crossed_after(0.15, true));
  ASSERT_TRUE(reflex.switched.has_value());
  EXPECT_EQ(reflex.switched->reason, SwitchReason::needed_after_all);
  EXPECT_EQ(reflex.switched->plan.policy, PolicyId::aeb);
  EXPECT_EQ(plane.under_way()->plan, reflex.switched->plan);
}

TEST(ReflexPlane, AfterTheAtlasTheForecastersVerdictIsLookedAtAsSoonAsItComes) {
  ReflexPlane plane(with_atlas());
  (void)plane.step(crossed_after(0.0, false));
  ASSERT_FALSE(plane.step(crossed_after(0.05, false)).switched) << "so says the atlas";
  plane.receive(verdict_of(0.06, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.5}}));
  EXPECT_TRUE(plane.step(crossed_after(0.06, false)).switched.has_value());
}

// Nobody can say what is needed: the small atlas knows no 20 m/s.
TEST(ReflexPlane, WhereNoVerdictComesAndNoAtlasKnowsItBrakesInFull) {
  for (const bool has_atlas : {false, true}) {
    ReflexPlane plane(has_atlas ? with_atlas() : ReflexTools{});
    plane.receive(verdict_of(0.0, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}}));
    ASSERT_EQ(plane.step(wreck_in(1.28)).plan, manoeuvre::doing_nothing);
    Scene later = wreck_in(1.18);
    later.time = 0.1;
    EXPECT_FALSE(plane.step(later).switched) << "the verdict is not too old yet";
    later = wreck_in(1.0);
    later.time = 0.28;
    EXPECT_FALSE(plane.step(later).switched) << "the next may still come";
    later = wreck_in(0.96);
    later.time = 0.32;
    const Reflex reflex = plane.step(later);
    ASSERT_TRUE(reflex.switched.has_value());
    EXPECT_EQ(reflex.switched->reason, SwitchReason::cannot_be_judged);
    EXPECT_EQ(reflex.plan, manoeuvre::full_braking);
  }
}

// Gentle braking, and 12 m are left, which it does not stop within (0.3 of the grip of 0.9: 29 m).
TEST(ReflexPlane, WhereNoVerdictComesTheAtlasBrakesHarder) {
  ReflexPlane plane(with_atlas());
  plane.receive(braking_verdict(0.0, 0.2, 0.2, 0.2, 0.0));
  ASSERT_EQ(plane.step(slow_wreck_in(1.28)).plan, braking_at(0.3));
  Scene later = slow_wreck_in(0.96);
  later.time = 0.32;
  const Reflex reflex = plane.step(later);
  ASSERT_TRUE(reflex.switched.has_value());
  EXPECT_EQ(reflex.switched->reason, SwitchReason::harder_needed);
  EXPECT_GT(strength_of(reflex.plan), 0.3);
}

TEST(ReflexPlane, TakesTheMostSimilarOfSeveral) {
  Scene other = wreck_in(1.3);
  other.actors[0].X_WA.p.y = 0.4;
  PlanCache cache = one_plan(other, PolicyId::aes_right);
  cache.push_back(one_plan(wreck_in(1.29), PolicyId::aes_left)[0]);
  ReflexPlane plane{ReflexTools{}};
  plane.receive(cache);
  EXPECT_EQ(plane.step(wreck_in(1.29)).plan.policy, PolicyId::aes_left);
}

TEST(ReflexPlane, KeepsItsPlan) {
  ReflexPlane plane{ReflexTools{}};
  (void)plane.step(wreck_in(1.2));
  plane.receive(one_plan(wreck_in(1.0), PolicyId::aes_left));
  const Reflex later = plane.step(wreck_in(1.0));
  EXPECT_FALSE(later.triggered);
  EXPECT_EQ(later.plan.policy, PolicyId::aeb);
}

TEST(ReflexPlane, DoesWhatTheUserAsksFor) {
  ReflexPlane plane({.forced = manoeuvre::doing_nothing});
  plane.receive(one_plan(wreck_in(1.3), PolicyId::aes_left));
  EXPECT_EQ(plane.step(wreck_in(1.2)).plan.policy, PolicyId::no_intervention);
  EXPECT_EQ(plane.decision()->source, Source::forced);
}

TEST(ReflexPlane, APlanThatIsAskedForBrakesToHalfOfTheSpeedUnlessItSaysToWhich) {
  const Scene scene = wreck_in(1.2);
  const PolicyId policy = PolicyId::es_b_left;
  ReflexPlane without({.forced = manoeuvre::Plan{policy, std::nullopt}});
  EXPECT_EQ(without.step(scene).plan.target_speed, 0.5 * norm(scene.ego.v_B));
  ReflexPlane with({.forced = manoeuvre::Plan{policy, 3.0}});
  EXPECT_EQ(with.step(scene).plan.target_speed, 3.0);
}

TEST(ReflexPlane, LeavesABrokenSceneAside) {
  ReflexPlane plane{ReflexTools{}};
  Scene broken = wreck_in(0.5);
  broken.actors[0].v_W.x = std::numeric_limits<double>::quiet_NaN();
  const Reflex reflex = plane.step(broken);
  EXPECT_TRUE(reflex.refused_scene);
  EXPECT_EQ(reflex.plan.policy, PolicyId::no_intervention);
  EXPECT_TRUE(plane.step(wreck_in(0.5)).triggered);  // the next good one counts
  EXPECT_EQ(plane.step(broken).plan.policy, PolicyId::aeb);
}

/// As many as there may be, a wreck ahead.
Scene crowd() {
  Scene crowded = slow_wreck_in(2.0);
  for (std::uint8_t id = 2; id <= world::max_actors; ++id) {
    crowded.actors.push_back(car(id, {30.0 + 6.0 * id, id % 2 == 0 ? 3.5 : -4.0}, {10.0, 0.3}));
  }
  return crowded;
}

/// Within T1, and somebody follows.
Scene near_crowd() {
  Scene scene = crowd();
  scene.actors[0].X_WA.p.x -= 15.0;
  scene.actors[1] = car(2, {-12.0, 0.0}, {12.5, 0.0});
  return scene;
}

/// Nobody within T1, and then nothing is seen for 2 s.
Scene long_before(const Scene& now) {
  Scene scene = now;
  scene.time -= 2.0;
  scene.actors[0].X_WA.p.x += 15.0;
  return scene;
}

// The kernel itself says so: any other system call than to end the process would end it at once.
TEST(ReflexPlane, MakesNoSystemCall) {
  const std::string why = why_system_calls_cannot_be_forbidden();
  if (!why.empty()) {
    GTEST_SKIP() << why;
  }
  ReflexPlane asks_the_atlas(with_atlas());
  ReflexPlane has_a_verdict(with_atlas());
  const Scene now = near_crowd();
  const Scene crowded = long_before(now);
  Scene later = now;
  later.time = 0.2;
  const PlanCache plans = one_plan(now, PolicyId::aes_left);
  const Verdict old = verdict_of(-1.0, {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}});
  const Verdict fresh = verdict_of(0.0, {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}});
  const Verdict newer = verdict_of(0.2, {{PolicyId::aeb, 0.0}, {PolicyId::aes_left, 0.2}});
  const auto decides = [&](ReflexPlane& plane, const Verdict& verdict, bool by_atlas) {
    plane.receive(plans);
    plane.receive(verdict);
    const bool waits = !plane.step(crowded).triggered;
    const bool triggers = plane.step(now).triggered && plane.decision()->by_atlas == by_atlas;
    plane.receive(newer);
    (void)plane.step(later);  // supervised
    return waits && triggers;
  };
  EXPECT_EXIT(
      {
        forbid_system_calls();
        const bool is_right =
            decides(asks_the_atlas, old, true) && decides(has_a_verdict, fresh, false);
        ::_exit(is_right ? 0 : 3);
      },
      testing::ExitedWithCode(0), "");
}

TEST(SystemCalls, AreNoticedWhereTheyAreForbidden) {
  const std::string why = why_system_calls_cannot_be_forbidden();
  if (!why.empty()) {
    GTEST_SKIP() << why;
  }
  EXPECT_EXIT(
      {
        forbid_system_calls();
        (void)::getppid();
        ::_exit(0);
      },
      testing::ExitedWithCode(1), "system call " + std::to_string(SYS_getppid));
}

TEST(ReflexPlane, AllocatesNothing) {
  const Scene now = near_crowd();
  const Scene crowded = long_before(now);
  PlanCache cache;
  while (!cache.full()) {
    cache.push_back(one_plan(now, PolicyId::aes_left)[0]);
  }
  ReflexPlane plane(with_atlas());
  const std::size_t before = num_allocations;
  plane.receive(cache);
  (void)plane.step(crowded);
  const Reflex reflex = plane.step(now);
  Scene later = now;
  later.time = 0.2;
  Verdict verdict = verdict_of(0.2, {{PolicyId::aeb, 0.2}, {PolicyId::aes_left, 0.0}});
  plane.receive(verdict);
  (void)plane.step(later);
  EXPECT_EQ(num_allocations, before);
  EXPECT_TRUE(reflex.triggered);
  EXPECT_TRUE(plane.decision()->by_atlas);
}

}  // namespace
}  // namespace saca::reflex::reflex_plane_test

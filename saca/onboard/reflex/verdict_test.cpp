#include "saca/onboard/reflex/verdict.h"

#include <gtest/gtest.h>

#include <array>

#include "saca/onboard/reflex/verdict_for_test.h"

namespace saca::reflex::verdict_test {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;

TEST(Verdict, OfNothingIsBraking) {
  const Verdict empty;
  EXPECT_EQ(admissible_harm(empty), std::nullopt);
  EXPECT_EQ(num_admissible(empty), 0U);
  EXPECT_EQ(plan_of(empty).policy, PolicyId::aeb);
  EXPECT_FALSE(admits(empty, {PolicyId::aeb, std::nullopt}));
}

// 0.002 or 3 % of what braking has above the best, whichever is more.
TEST(Verdict, AdmitsWhatForecastsCannotTellApart) {
  EXPECT_DOUBLE_EQ(
      *admissible_harm(verdict_of(0.0, {{PolicyId::aeb, 0.011}, {PolicyId::aes_left, 0.010}})),
      0.012);
  EXPECT_DOUBLE_EQ(
      *admissible_harm(verdict_of(0.0, {{PolicyId::aeb, 0.21}, {PolicyId::aes_left, 0.01}})),
      0.016);
}

TEST(Verdict, SpeaksForDoingNothingWhereThatIsAdmissible) {
  const auto chosen = [](double aeb, double swerve, double nothing) {
    return plan_of(verdict_of(0.0, {{PolicyId::aeb, aeb},
                                    {PolicyId::aes_right, swerve},
                                    {PolicyId::no_intervention, nothing}}))
        .policy;
  };
  EXPECT_EQ(chosen(0.0, 0.0, 0.0), PolicyId::no_intervention);
  EXPECT_EQ(chosen(0.0, 0.0, 0.0019), PolicyId::no_intervention);
  EXPECT_EQ(chosen(0.0, 0.0, 0.0021), PolicyId::aeb);
  // Whoever stands and is about to be run into cannot be helped by braking.
  EXPECT_EQ(chosen(0.09, 0.09, 0.09), PolicyId::no_intervention);
  // Where braking is far worse, the tolerance is 3 % of what it has above the best: 0.0097 here.
  EXPECT_EQ(chosen(0.3242, 0.001, 0.0106), PolicyId::no_intervention);
  EXPECT_EQ(chosen(0.3242, 0.001, 0.0108), PolicyId::aes_right);
}

TEST(Verdict, DoesNotSpeakForDoingNothingWhereThatCannotBeJudged) {
  Verdict verdict = verdict_of(0.0, {{PolicyId::aeb, 0.1}, {PolicyId::no_intervention, 0.0}});
  verdict.plans[1].drivable = false;
  EXPECT_EQ(plan_of(verdict).policy, PolicyId::aeb);
}

TEST(Verdict, SpeaksForBrakingWhereItIsAdmissible) {
  EXPECT_EQ(plan_of(verdict_of(0.0, {{PolicyId::aeb, 0.0215},
                                     {PolicyId::aes_left, 0.02},
                                     {PolicyId::no_intervention, 0.3}}))
                .policy,
            PolicyId::aeb);
}

TEST(Verdict, SpeaksForTheMildestElse) {
  const Verdict verdict = verdict_of(0.0, {{PolicyId::aeb, 0.3},
                                           {PolicyId::aes_left, 0.0},
                                           {PolicyId::es_b_left, 0.002},
                                           {PolicyId::es_b_right, 0.001},
                                           {PolicyId::t_drift_left, 0.0}});
  EXPECT_EQ(plan_of(verdict).policy, PolicyId::es_b_right);
  EXPECT_EQ(num_admissible(verdict), 4U);
}

TEST(Verdict, LeavesOutWhatCannotBeDriven) {
  Verdict verdict = verdict_of(0.0, {{PolicyId::aeb, 0.3}, {PolicyId::aes_left, 0.0}});
  verdict.plans[1].drivable = false;
  EXPECT_EQ(plan_of(verdict).policy, PolicyId::aeb);
  EXPECT_FALSE(admits(verdict, {PolicyId::aes_left, std::nullopt}));
}

// A plan cached at 24.9 m/s brakes to 12.45; judged at 25.2 it is the one to 12.6.
TEST(Verdict, KnowsAPlanAgainAtAnotherSpeed) {
  Verdict verdict;
  for (const double target : {0.0, 6.3, 12.6, 18.9}) {
    verdict.plans.push_back(
        {.plan = {PolicyId::es_b_left, target}, .drivable = true, .harm = target, .contact = 0.5});
  }
  EXPECT_EQ(find_plan(verdict, {PolicyId::es_b_left, 12.45})->plan.target_speed, 12.6);
  EXPECT_EQ(find_plan(verdict, {PolicyId::es_b_right, 12.45}), nullptr);
}

TEST(Verdict, BrakesWithTheStrengthOfTheLeastExpectedHarm) {
  // Full braking is run into from behind, gentle braking hits the one ahead.
  EXPECT_EQ(plan_of(braking_verdict(0.0, 0.05, 0.02, 0.001, 0.08)), braking_at(0.6));
  EXPECT_EQ(plan_of(braking_verdict(0.0, 0.0041, 0.0021, 0.0, 0.0005)), braking_at(0.6));
}

// What forecasts cannot tell apart, 0.002, is a tie: the harder leaves more to what nobody foresees
// ahead.
TEST(Verdict, BrakesTheHardestWhereStrengthsHarmAlike) {
  EXPECT_EQ(plan_of(braking_verdict(0.0, 0.0, 0.0, 0.0, 0.0)), manoeuvre::full_braking);
  EXPECT_EQ(plan_of(braking_verdict(0.0, 0.0321, 0.0319, 0.03, 0.03)), braking_at(0.8));
  EXPECT_EQ(plan_of(braking_verdict(0.0, 0.0319, 0.033, 0.03, 0.03)), manoeuvre::full_braking);
}

// Full braking is no rock to stand on then: expected harm decides, and braking is the milder.
TEST(Verdict, BrakesGentlyOrSwervesByExpectedHarmWhereFullBrakingIsNotAdmissible) {
  const Plan swerve{PolicyId::aes_left, std::nullopt};
  const auto chosen = [&](double gentle, double swerving) {
    Verdict verdict = braking_verdict(0.0, 0.3, 0.1, gentle, 0.2);
    add_to(verdict, swerve, swerving);
    EXPECT_FALSE(admits(verdict, manoeuvre::full_braking));
    EXPECT_TRUE(admits(verdict, braking_at(0.6)) && admits(verdict, swerve));
    return plan_of(verdict);
  };
  EXPECT_EQ(chosen(0.001, 0.002), braking_at(0.6));
  EXPECT_EQ(chosen(0.001, 0.00095), braking_at(0.6));
  EXPECT_EQ(chosen(0.001, 0.0), swerve);
}

// By hand: 0.8 of the grip 0.02 / 2 + (0.08 + 0.04) / 4; 0.6 likewise; 0.3 has one neighbour.
TEST(Verdict, StrengthsAreToldWithTheirNeighbours) {
  Verdict verdict = braking_verdict(0.0, 0.08, 0.02, 0.04, 0.12);
  add_to(verdict, {PolicyId::aes_left, std::nullopt}, 0.7);
  const double nothing = find_plan(verdict, manoeuvre::doing_nothing)->harm;
  spread_over_strengths(verdict);
  EXPECT_EQ(find_plan(verdict, manoeuvre::full_braking)->harm, 0.08);
  EXPECT_NEAR(find_plan(verdict, braking_at(0.8))->harm, 0.04, 1e-12);
  EXPECT_NEAR(find_plan(verdict, braking_at(0.6))->harm, 0.055, 1e-12);
  EXPECT_NEAR(find_plan(verdict, braking_at(0.3))->harm, 0.1, 1e-12);
  EXPECT_EQ(find_plan(verdict, {PolicyId::aes_left, std::nullopt})->harm, 0.7);
  EXPECT_EQ(find_plan(verdict, manoeuvre::doing_nothing)->harm, nothing);
  Verdict flat = braking_verdict(0.0, 0.01, 0.01, 0.01, 0.01);
  spread_over_strengths(flat);
  EXPECT_DOUBLE_EQ(find_plan(flat, braking_at(0.6))->harm, 0.01);
  EXPECT_DOUBLE_EQ(find_plan(flat, braking_at(0.6))->contact, 0.5);
}

TEST(Verdict, HasNoBestBrakingWhereNoneCanBeDriven) {
  EXPECT_EQ(best_braking(Verdict{}), nullptr);
  EXPECT_EQ(best_braking(verdict_of(0.0, {{PolicyId::aes_left, 0.0}})), nullptr);
}

// Memory and model know policies, no strengths.
TEST(Verdict, TakesPolicyZeroForTheBestBrakingAndLeavesOthersAlone) {
  const Verdict verdict = braking_verdict(0.0, 0.05, 0.02, 0.001, 0.08);
  EXPECT_EQ(as_judged(verdict, manoeuvre::full_braking), braking_at(0.6));
  EXPECT_EQ(as_judged(verdict, braking_at(0.3)), braking_at(0.6));
  const Plan swerve{PolicyId::es_b_left, 7.0};
  EXPECT_EQ(as_judged(verdict, swerve), swerve);
  EXPECT_EQ(as_judged(Verdict{}, manoeuvre::full_braking), manoeuvre::full_braking);
}

TEST(Verdict, KnowsAStrengthByTheNearest) {
  const Verdict verdict = braking_verdict(0.0, 0.05, 0.02, 0.001, 0.08);
  EXPECT_EQ(find_plan(verdict, manoeuvre::full_braking)->plan, manoeuvre::full_braking);
  EXPECT_EQ(find_plan(verdict, braking_at(1.0))->plan, manoeuvre::full_braking);
  EXPECT_EQ(find_plan(verdict, braking_at(0.66))->plan, braking_at(0.6));
  EXPECT_EQ(find_plan(verdict, braking_at(0.2))->plan, braking_at(0.3));
}

// Whatever is chosen is at most by the tolerance worse than full braking, however hard that is.
TEST(Verdict, IsNeverKnowinglyWorseThanFullBrakingWithAnyStrength) {
  const std::array harms{0.0, 0.00005, 0.001, 0.0021, 0.05, 0.4};
  for (const double full : harms) {
    for (const double hard : harms) {
      for (const double gentle : harms) {
        for (const double swerve : harms) {
          Verdict verdict = braking_verdict(0.0, full, hard, hard, gentle);
          add_to(verdict, {PolicyId::aes_left, std::nullopt}, swerve);
          const JudgedPlan& chosen = *find_plan(verdict, plan_of(verdict));
          EXPECT_LE(chosen.harm, full) << full << ' ' << hard << ' ' << gentle << ' ' << swerve;
          EXPECT_LE(chosen.harm, *admissible_harm(verdict));
        }
      }
    }
  }
}

// Whatever is chosen is at most by the tolerance worse than braking.
TEST(Verdict, IsNeverKnowinglyWorseThanBraking) {
  for (const double aeb : {0.0, 0.001, 0.0019, 0.0021, 0.05, 0.4}) {
    for (const double other : {0.0, 0.001, 0.003, 0.049, 0.051, 0.5}) {
      const Verdict verdict = verdict_of(
          0.0,
          {{PolicyId::aeb, aeb}, {PolicyId::aes_left, other}, {PolicyId::no_intervention, 0.5}});
      const Plan plan = plan_of(verdict);
      EXPECT_LE(find_plan(verdict, plan)->harm, aeb) << aeb << ' ' << other;
    }
  }
}

}  // namespace
}  // namespace saca::reflex::verdict_test

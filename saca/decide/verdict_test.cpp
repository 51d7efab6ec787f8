#include "saca/decide/verdict.h"

#include <gtest/gtest.h>

#include "saca/decide/verdict_for_test.h"

namespace saca::decide::verdict_test {
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

TEST(Verdict, SpeaksForDoingNothingOnlyWhereThatTouchesNobody) {
  EXPECT_EQ(
      plan_of(verdict_of(0.0, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.0}})).policy,
      PolicyId::no_intervention);
  // Inside the tolerance, but with contact: braking costs nothing.
  EXPECT_EQ(
      plan_of(verdict_of(0.0, {{PolicyId::aeb, 0.0}, {PolicyId::no_intervention, 0.001}})).policy,
      PolicyId::aeb);
  // Also where braking is far from admissible, nothing is not done.
  EXPECT_EQ(plan_of(verdict_of(0.0, {{PolicyId::aeb, 0.1},
                                     {PolicyId::aes_right, 0.001},
                                     {PolicyId::no_intervention, 0.001}}))
                .policy,
            PolicyId::aes_right);
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
}  // namespace saca::decide::verdict_test

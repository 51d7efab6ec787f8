#include "saca/decide/corrected_verdict.h"

#include <gtest/gtest.h>

#include "saca/decide/verdict_for_test.h"

namespace saca::decide::corrected_verdict_test {
namespace {

using manoeuvre::PolicyId;

/// 0 but for these two.
memory::Corrections with(PolicyId a, double one, PolicyId b, double other) {
  memory::Corrections corrections{};
  corrections[manoeuvre::index(a)] = one;
  corrections[manoeuvre::index(b)] = other;
  return corrections;
}

TEST(ACorrection, AddsToEveryPlanOfAPolicyAndNoneHarmsLessThanNothing) {
  Verdict verdict = verdict_of(
      0.0, {{PolicyId::aeb, 0.20}, {PolicyId::aes_left, 0.03}, {PolicyId::no_intervention, 0.10}});
  add_to(verdict, braking_at(0.6), 0.25);
  verdict.under_way = verdict.plans[1];
  correct(verdict, with(PolicyId::aeb, 0.05, PolicyId::aes_left, -0.04));
  EXPECT_DOUBLE_EQ(verdict.plans[0].harm, 0.25);
  EXPECT_EQ(verdict.plans[1].harm, 0.0);
  EXPECT_DOUBLE_EQ(verdict.plans[2].harm, 0.10);
  EXPECT_DOUBLE_EQ(verdict.plans[3].harm, 0.30);
  EXPECT_EQ(verdict.under_way->harm, 0.0);
}

TEST(ACorrection, CanMakeAnotherPlanTheBest) {
  Verdict verdict = verdict_of(0.0, {{PolicyId::aeb, 0.05}, {PolicyId::es_b_left, 0.01}});
  EXPECT_EQ(plan_of(verdict).policy, PolicyId::es_b_left);
  correct(verdict, with(PolicyId::es_b_left, 0.06, PolicyId::aeb, -0.01));
  EXPECT_EQ(plan_of(verdict).policy, PolicyId::aeb);
}

TEST(ACorrection, LeavesWhatWaitingCosts) {
  Verdict verdict = verdict_of(0.0, {{PolicyId::aeb, 0.05}, {PolicyId::es_b_left, 0.01}});
  verdict.later = 0.03;
  correct(verdict, with(PolicyId::es_b_left, 0.06, PolicyId::aeb, -0.01));
  EXPECT_NEAR(cost_of_waiting(verdict).value(), 0.02, 1e-12);
}

TEST(ACorrection, OfNothingChangesNothing) {
  Verdict verdict;
  verdict.later = 0.1;
  correct(verdict, with(PolicyId::aeb, 0.1, PolicyId::aes_left, 0.1));
  EXPECT_EQ(verdict.later, 0.1);
  Verdict as_it_was = verdict_of(0.0, {{PolicyId::aeb, 0.05}});
  correct(as_it_was, {});
  EXPECT_EQ(as_it_was.plans[0].harm, 0.05);
}

}  // namespace
}  // namespace saca::decide::corrected_verdict_test

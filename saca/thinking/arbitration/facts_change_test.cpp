#include "saca/thinking/arbitration/facts_change.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saca::arbitration::facts_change_test {
namespace {

using manoeuvre::PolicyId;

/// Braking harms 0.05, a swerve to the left so much, all else 0.2.
AllFacts facts(double swerve) {
  AllFacts all;
  for (const PolicyId policy : manoeuvre::all_policies) {
    all[manoeuvre::index(policy)].plan = manoeuvre::default_plan(policy, 20.0);
    all[manoeuvre::index(policy)].outcome().harm = 0.2;
  }
  all[manoeuvre::index(PolicyId::aeb)].outcome().harm = 0.05;
  all[manoeuvre::index(PolicyId::aes_left)].outcome().harm = swerve;
  return all;
}

TEST(Regret, IsWhatAPolicyHarmsMoreThanTheLeast) {
  AllFacts all = facts(0.02);
  EXPECT_NEAR(regret(all, PolicyId::aeb), 0.03, 1e-12);
  EXPECT_EQ(regret(all, PolicyId::aes_left), 0.0);
  // What cannot be driven is no measure for others.
  all[manoeuvre::index(PolicyId::aes_left)].end = preview::Refusal{"too fast"};
  EXPECT_EQ(regret(all, PolicyId::aeb), 0.0);
  EXPECT_TRUE(std::isinf(regret(all, PolicyId::aes_left)));
}

TEST(ChangedPolicy, IsOneThatWasAsGoodAsTheBestAndIsMateriallyWorse) {
  EXPECT_EQ(changed_policy(facts(0.05), facts(0.061)), PolicyId::aes_left);
  EXPECT_EQ(changed_policy(facts(0.061), facts(0.0505)), PolicyId::aes_left);  // and back
  EXPECT_EQ(changed_policy(facts(0.05), facts(0.03)), PolicyId::aeb);  // braking is worse now
  AllFacts refused = facts(0.05);
  refused[manoeuvre::index(PolicyId::aes_left)].end = preview::Refusal{"too fast"};
  EXPECT_EQ(changed_policy(facts(0.05), refused), PolicyId::aes_left);
}

TEST(ChangedPolicy, IsNoneWhereFactsWaver) {
  EXPECT_EQ(changed_policy(facts(0.05), facts(0.05)), std::nullopt);
  EXPECT_EQ(changed_policy(facts(0.05), facts(0.059)), std::nullopt);
  EXPECT_EQ(changed_policy(facts(0.053), facts(0.07)), std::nullopt);
  EXPECT_EQ(changed_policy(facts(0.1), facts(0.3)), std::nullopt);
}

// The one is an expectation with the spread of places, the other is one future.
TEST(ChangedPolicy, DoesNotCompareTheAtlasWithFullDynamics) {
  AllFacts rolled = facts(0.3);
  for (preview::PolicyFacts& fact : rolled) {
    fact.end = preview::RolledOutcome{fact.outcome()};
  }
  EXPECT_EQ(changed_policy(facts(0.05), rolled), std::nullopt);
}

}  // namespace
}  // namespace saca::arbitration::facts_change_test

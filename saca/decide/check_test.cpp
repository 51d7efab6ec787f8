#include "saca/decide/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::decide {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

/// Braking hits at some harm, everything else is clear, but for what a test changes.
preview::Situation situation(double harm_of_braking) {
  preview::Situation made;
  made.scene_at_trigger.actors.push_back({.id = 1});
  for (const PolicyId policy : manoeuvre::all_policies) {
    auto& fact = made.facts[manoeuvre::index(policy)];
    fact.plan = manoeuvre::default_plan(policy, 20.0);
    fact.outcome.clearance = 1.0;
  }
  auto& aeb = made.facts[manoeuvre::index(PolicyId::aeb)].outcome;
  if (harm_of_braking > 0.0) {
    aeb.contact = outcome::Contact{.actor = 0, .relative_speed = 5.0};
    aeb.harm = harm_of_braking;
  }
  return made;
}

TEST(Check, PassesWhatHarmsLessThanBraking) {
  EXPECT_TRUE(check(PolicyId::aes_left, situation(0.1)).passed);
}

TEST(Check, BrakingItselfAlwaysPasses) {
  EXPECT_TRUE(check(PolicyId::aeb, situation(0.1)).passed);
}

TEST(Check, FailsWhatHarmsMore) {
  preview::Situation worse = situation(0.1);
  auto& outcome = worse.facts[manoeuvre::index(PolicyId::aes_left)].outcome;
  outcome.contact = outcome::Contact{.actor = 0, .relative_speed = 9.0};
  outcome.harm = 0.2;
  const Check result = check(PolicyId::aes_left, worse);
  EXPECT_FALSE(result.passed);
  EXPECT_THAT(result.text, HasSubstr("braking"));
}

TEST(Check, TiesGoToTheMilder) {
  EXPECT_FALSE(check(PolicyId::aes_left, situation(0.0)).passed);        // both are clear
  EXPECT_TRUE(check(PolicyId::no_intervention, situation(0.0)).passed);  // milder than braking
}

TEST(Check, FailsWhatCannotBeDriven) {
  preview::Situation refused = situation(0.1);
  refused.facts[manoeuvre::index(PolicyId::aes_left)].refusal = "too fast";
  EXPECT_FALSE(check(PolicyId::aes_left, refused).passed);
}

}  // namespace
}  // namespace saca::decide

#include "saca/onboard/manoeuvre/plan.h"

#include <gtest/gtest.h>

#include <array>

namespace saca::manoeuvre::plan_test {
namespace {

// Table I of the paper.
TEST(Plan, PoliciesHaveThePapersNumbersAndNames) {
  EXPECT_EQ(name(PolicyId::aeb), "AEB");
  EXPECT_EQ(name(PolicyId::aes_left), "AES-L");
  EXPECT_EQ(name(PolicyId::es_b_right), "ES-B-R");
  EXPECT_EQ(name(PolicyId::t_drift_left), "T-D-L");
  EXPECT_EQ(name(PolicyId::no_intervention), "NI");
  for (std::size_t id = 0; id < num_policies; ++id) {
    EXPECT_EQ(policy_from(static_cast<int>(id)), all_policies[id]);
    EXPECT_EQ(index(all_policies[id]), id);
  }
}

TEST(Plan, NoOtherNumberIsAPolicy) {
  EXPECT_EQ(policy_from(-1), std::nullopt);
  EXPECT_EQ(policy_from(8), std::nullopt);
}

TEST(Plan, PoliciesGoWhereTheirNamesSay) {
  for (const PolicyId policy : all_policies) {
    const std::string_view words = name(policy);
    EXPECT_EQ(side(policy), words.ends_with("-L") ? 1 : words.ends_with("-R") ? -1 : 0) << words;
    EXPECT_EQ(changes_lane(policy), words.starts_with("AES") || words.starts_with("ES-B")) << words;
  }
}

TEST(Plan, OnlyBrakedLaneChangesHaveATargetSpeed) {
  for (const PolicyId policy : all_policies) {
    const bool braked = policy == PolicyId::es_b_left || policy == PolicyId::es_b_right;
    const Plan plan = default_plan(policy, 14.0);
    EXPECT_EQ(plan.policy, policy);
    EXPECT_EQ(plan.target_speed, braked ? std::optional(7.0) : std::nullopt);
  }
}

TEST(Plan, OnlyPolicyZeroHasAStrengthAndByDefaultItIsAll) {
  for (const PolicyId policy : all_policies) {
    EXPECT_EQ(takes_strength(policy), index(policy) == 0) << name(policy);
    EXPECT_EQ(default_plan(policy, 14.0).strength, std::nullopt);
  }
  EXPECT_EQ(strength_of(full_braking), 1.0);
  EXPECT_EQ(strength_of({.policy = PolicyId::aeb, .strength = 0.3}), 0.3);
}

// They are tried one after the other: the hardest first, all of them can be asked for.
TEST(Plan, MostLikeIsOfThePolicyAndNearestInSpeedAndStrength) {
  struct Planned {
    Plan plan;
  };
  const std::array all{Planned{{PolicyId::es_b_left, 4.0}}, Planned{{PolicyId::es_b_left, 6.0}},
                       Planned{full_braking}, Planned{{PolicyId::aeb, std::nullopt, 0.4}}};
  const auto like = [&](const Plan& plan) { return most_like<Planned>(all, plan); };
  EXPECT_EQ(like({PolicyId::es_b_left, 5.5}), &all[1]);
  EXPECT_EQ(like({PolicyId::es_b_left, 5.0}), &all[0]) << "as near: the first";
  EXPECT_EQ(like({PolicyId::aeb, std::nullopt, 0.8}), &all[2]);
  EXPECT_EQ(like({PolicyId::aeb, std::nullopt, 0.6}), &all[3]);
  EXPECT_EQ(like({PolicyId::es_b_right, 5.0}), nullptr);
}

TEST(Plan, StrengthsThatAreChosenFromFall) {
  double last = 1.0;
  for (const double strength : braking_strengths) {
    EXPECT_LT(strength, last);
    EXPECT_GE(strength, least_strength);
    last = strength;
  }
}

TEST(Plan, IsToldWithItsSpeedOrStrength) {
  EXPECT_EQ(plan_text(full_braking), "0 AEB");
  EXPECT_EQ(plan_text({.policy = PolicyId::aeb, .strength = 1.0}), "0 AEB");
  EXPECT_EQ(plan_text({.policy = PolicyId::aeb, .strength = 0.45}), "0 AEB at 45 % of the grip");
  EXPECT_EQ(plan_text({PolicyId::es_b_left, 7.0}), "3 ES-B-L to 7.0 m/s");
  EXPECT_EQ(plan_text(doing_nothing), "7 NI");
}

TEST(Plan, APolicyIsNamedByItsNumberOrItsShortNameInAnyCase) {
  for (const PolicyId policy : all_policies) {
    EXPECT_EQ(policy_named(std::to_string(index(policy))), policy);
    EXPECT_EQ(policy_named(name(policy)), policy);
  }
  EXPECT_EQ(policy_named("aeb"), PolicyId::aeb);
  EXPECT_EQ(policy_named("es_b-L"), PolicyId::es_b_left);
  for (const char* wrong : {"", "8", "-1", "00", "AE", "AEBS", "left", "1.0"}) {
    EXPECT_EQ(policy_named(wrong), std::nullopt) << wrong;
  }
}

}  // namespace
}  // namespace saca::manoeuvre::plan_test

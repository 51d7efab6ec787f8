#include "saca/manoeuvre/plan.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saca::manoeuvre::plan_test

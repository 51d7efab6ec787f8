#include "saca/thinking/preview/plan_facts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::preview::plan_facts_test {
namespace {

using manoeuvre::PolicyId;

// What must not compile, beside its twins that do.
template <class A, class B>
concept Comparable = requires(const A& a, const B& b) {
  better(a, PolicyId::aeb, b, PolicyId::aeb);
};
static_assert(Comparable<ExpectedOutcome, ExpectedOutcome>);
static_assert(Comparable<RolledOutcome, RolledOutcome>);
static_assert(!Comparable<ExpectedOutcome, RolledOutcome>);
static_assert(!Comparable<RolledOutcome, ExpectedOutcome>);
static_assert(!Comparable<ExpectedOutcome, Refusal>);
static_assert(!Comparable<Refusal, Refusal>);

PolicyFacts expected(PolicyId policy, double harm) {
  return {.plan = {policy, std::nullopt},
          .end = ExpectedOutcome{.outcome = {.harm = harm}, .contact_probability = 0.25}};
}
PolicyFacts rolled(PolicyId policy, double harm) {
  return {.plan = {policy, std::nullopt}, .end = RolledOutcome{.outcome = {.harm = harm}}};
}
PolicyFacts refused(PolicyId policy) {
  return {.plan = {policy, std::nullopt}, .end = Refusal{"too fast"}};
}

TEST(PlanFacts, HaveWhatTheirKindHas) {
  PolicyFacts contact = rolled(PolicyId::aeb, 0.3);
  EXPECT_EQ(contact.contact_probability(), 0.0);
  contact.outcome().contact = collision::Contact{};
  EXPECT_EQ(contact.contact_probability(), 1.0);
  EXPECT_EQ(expected(PolicyId::aeb, 0.3).contact_probability(), 0.25);
  EXPECT_EQ(expected(PolicyId::aeb, 0.3).outcome().harm, 0.3);
  EXPECT_EQ(refused(PolicyId::aeb).refusal(), "too fast");
  EXPECT_FALSE(refused(PolicyId::aeb).drivable());
}

TEST(PlanFacts, RefuseWhatHasNoMeaning) {
  EXPECT_THROW((void)refused(PolicyId::aeb).outcome(), ContractViolation);
  EXPECT_THROW((void)refused(PolicyId::aeb).contact_probability(), ContractViolation);
  EXPECT_THROW((void)rolled(PolicyId::aeb, 0.0).refusal(), ContractViolation);
  EXPECT_THROW((void)better(rolled(PolicyId::aeb, 0.0), expected(PolicyId::aes_left, 0.1)),
               ContractViolation);
}

TEST(PlanFacts, WhatCanBeDrivenIsBetterThanWhatCannot) {
  EXPECT_TRUE(better(rolled(PolicyId::aeb, 9.0), refused(PolicyId::no_intervention)));
  EXPECT_FALSE(better(refused(PolicyId::no_intervention), rolled(PolicyId::aeb, 9.0)));
  EXPECT_FALSE(better(refused(PolicyId::aeb), refused(PolicyId::aes_left)));
}

TEST(PlanFacts, AreOrderedByHarmThenByMildness) {
  for (const auto& of : {expected, rolled}) {
    EXPECT_TRUE(better(of(PolicyId::aes_left, 0.1), of(PolicyId::aeb, 0.2)));
    EXPECT_TRUE(better(of(PolicyId::aeb, 0.1), of(PolicyId::aes_left, 0.1)));
    EXPECT_FALSE(better(of(PolicyId::aes_left, 0.1), of(PolicyId::aeb, 0.1)));
  }
}

AllFacts all(PolicyFacts (*of)(PolicyId, double)) {
  AllFacts facts;
  for (const PolicyId policy : manoeuvre::all_policies) {
    const std::size_t i = manoeuvre::index(policy);
    facts[i] = of(policy, 0.1 * (1.0 + static_cast<double>(i)));
  }
  return facts;
}

TEST(AllFacts, TheLeastHarmIsOfWhatCanBeDriven) {
  for (const auto& of : {expected, rolled}) {
    AllFacts facts = all(of);
    EXPECT_EQ(rolled_out(facts), of == rolled);
    EXPECT_EQ(least_harm(facts), 0.1);
    facts[0] = refused(PolicyId::aeb);
    EXPECT_EQ(least_harm(facts), 0.2);
    for (PolicyFacts& fact : facts) {
      fact.end = Refusal{};
    }
    EXPECT_TRUE(std::isinf(least_harm(facts)));
  }
}

TEST(AllFacts, OfTwoKindsHaveNoLeastHarm) {
  AllFacts facts = all(rolled);
  facts[3] = expected(PolicyId::es_b_left, 0.0);
  EXPECT_THROW((void)least_harm(facts), ContractViolation);
}

}  // namespace
}  // namespace saca::preview::plan_facts_test

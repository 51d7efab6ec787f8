#include "saca/onboard/collision/ordering.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::collision::ordering_test {
namespace {

using manoeuvre::PolicyId;

Outcome outcome(double harm, double clearance = 1.0) {
  Outcome result;
  result.harm = harm;
  result.clearance = clearance;
  return result;
}

TEST(Milder, RanksByWhatIsTakenOutOfTheDriversHands) {
  EXPECT_TRUE(milder(PolicyId::no_intervention, PolicyId::aeb));
  for (const int id : {1, 2, 3, 4}) {
    EXPECT_TRUE(milder(PolicyId::aeb, static_cast<PolicyId>(id))) << id;
    EXPECT_TRUE(milder(static_cast<PolicyId>(id), PolicyId::t_drift_left)) << id;
    EXPECT_TRUE(milder(static_cast<PolicyId>(id), PolicyId::t_drift_right)) << id;
  }
  EXPECT_TRUE(milder(PolicyId::es_b_left, PolicyId::aes_right));
}

TEST(Milder, DoesNotTellLeftFromRightNorAPolicyFromItself) {
  EXPECT_FALSE(milder(PolicyId::aes_left, PolicyId::aes_right));
  EXPECT_FALSE(milder(PolicyId::aes_right, PolicyId::aes_left));
  EXPECT_FALSE(milder(PolicyId::aeb, PolicyId::aeb));
}

TEST(Better, LessHarmWinsWhateverThePolicy) {
  EXPECT_TRUE(better(outcome(0.01), PolicyId::t_drift_left, outcome(0.02), PolicyId::aeb));
  EXPECT_FALSE(better(outcome(0.02), PolicyId::aeb, outcome(0.01), PolicyId::t_drift_left));
}

TEST(Better, TiesGoToTheMilderSoThatNoInterventionCanWin) {
  EXPECT_TRUE(better(outcome(0.0), PolicyId::no_intervention, outcome(0.0), PolicyId::aeb));
  EXPECT_FALSE(better(outcome(0.0), PolicyId::aeb, outcome(0.0), PolicyId::no_intervention));
  EXPECT_TRUE(better(outcome(4e-5), PolicyId::aeb, outcome(0.0), PolicyId::aes_left));
}

TEST(Better, AmongEqualsPrefersTheWiderBerth) {
  EXPECT_TRUE(
      better(outcome(0.0, 1.2), PolicyId::aes_left, outcome(0.0, 0.7), PolicyId::aes_right));
  EXPECT_FALSE(
      better(outcome(0.0, 1.2), PolicyId::aes_left, outcome(0.0, 1.2001), PolicyId::aes_right));
}

// Property: a strict weak order, so that sorting and searching for the best are well defined.
TEST(Better, IsAStrictWeakOrder) {
  std::mt19937 rng(1);
  std::uniform_int_distribution<int> policy(0, 7);
  std::uniform_int_distribution<int> harm(0, 6);
  std::uniform_int_distribution<int> clearance(0, 3);
  struct Choice {
    Outcome result;
    PolicyId policy;
  };
  std::vector<Choice> choices;
  for (int i = 0; i < 40; ++i) {
    choices.push_back({outcome(0.4 * harm_tie * harm(rng), 0.4e-3 * clearance(rng)),
                       static_cast<PolicyId>(policy(rng))});
  }
  const auto less = [](const Choice& a, const Choice& b) {
    return better(a.result, a.policy, b.result, b.policy);
  };
  const auto equal = [&](const Choice& a, const Choice& b) { return !less(a, b) && !less(b, a); };
  for (const Choice& a : choices) {
    EXPECT_FALSE(less(a, a));
    for (const Choice& b : choices) {
      EXPECT_FALSE(less(a, b) && less(b, a));
      for (const Choice& c : choices) {
        EXPECT_TRUE(!(less(a, b) && less(b, c)) || less(a, c));
        EXPECT_TRUE(!(equal(a, b) && equal(b, c)) || equal(a, c));
      }
    }
  }
}

TEST(Better, RefusesWhatIsNoHarm) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, -0.1, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)better(outcome(bad), PolicyId::aeb, outcome(0.0), PolicyId::aeb),
                 ContractViolation);
    EXPECT_THROW((void)better(outcome(0.0), PolicyId::aeb, outcome(bad), PolicyId::aeb),
                 ContractViolation);
  }
  EXPECT_THROW((void)better(outcome(0.0, nan), PolicyId::aeb, outcome(0.0), PolicyId::aeb),
               ContractViolation);
}

}  // namespace
}  // namespace saca::collision::ordering_test

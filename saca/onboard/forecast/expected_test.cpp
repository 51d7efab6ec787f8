#include "saca/onboard/forecast/expected.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::forecast::expected_test {
namespace {

// Points of the t distribution to four figures, as every table of it has them.
TEST(StudentT, MatchesTheTables) {
  EXPECT_NEAR(student_t(1), 12.706, 1e-3);
  EXPECT_NEAR(student_t(2), 4.303, 1e-3);
  EXPECT_NEAR(student_t(3), 3.182, 6e-3);
  EXPECT_NEAR(student_t(4), 2.776, 1e-3);
  EXPECT_NEAR(student_t(9), 2.262, 5e-4);
  EXPECT_NEAR(student_t(29), 2.045, 5e-4);
  EXPECT_NEAR(student_t(1'000'000), 1.960, 5e-5);
}

// 1, 2, 3, 4: mean 2.5, variance 5/3, error of the mean sqrt(5/12).
TEST(Mean, OfFourByHand) {
  const Mean found = mean(std::vector<double>{1.0, 2.0, 3.0, 4.0});
  EXPECT_DOUBLE_EQ(found.value, 2.5);
  EXPECT_NEAR(found.high - 2.5, 3.182 * std::sqrt(5.0 / 12.0), 4e-3);
  EXPECT_NEAR(found.low, 5.0 - found.high, 1e-12);
}

TEST(Mean, ItsIntervalHoldsTheTruthIn95OfAHundred) {
  std::mt19937_64 rng(5);
  std::normal_distribution<double> normal(3.0, 2.0);
  int held = 0;
  constexpr int num_trials = 4000;
  for (int i = 0; i < num_trials; ++i) {
    std::vector<double> values(6);
    for (double& value : values) {
      value = normal(rng);
    }
    const Mean found = mean(values);
    held += found.low <= 3.0 && 3.0 <= found.high ? 1 : 0;
  }
  EXPECT_NEAR(held / double(num_trials), 0.95, 4.0 * std::sqrt(0.95 * 0.05 / num_trials));
}

std::vector<collision::Outcome> outcomes(const std::vector<double>& harms) {
  std::vector<collision::Outcome> all;
  for (const double harm : harms) {
    collision::Outcome outcome{.collision_loss = 2.0 * harm, .harm = harm};
    if (harm > 0.0) {
      outcome.contact = collision::Contact{};
    }
    all.push_back(outcome);
  }
  return all;
}

TEST(MeanOutcome, TellsHarmLossAndShareOfContacts) {
  const MeanOutcome found = expected(outcomes({0.0, 0.0, 1.0, 3.0}));
  EXPECT_DOUBLE_EQ(found.harm.value, 1.0);
  EXPECT_DOUBLE_EQ(found.collision_loss.value, 2.0);
  EXPECT_DOUBLE_EQ(found.contact.share, 0.5);
  EXPECT_DOUBLE_EQ(found.contact.low, proportion(2, 4).low);
}

// Both suffer the same luck; one is worse by 0.1 in each draw.
TEST(HarmDifference, OfCommonDrawsLosesTheLuck) {
  const auto a = outcomes({0.5, 1.5, 3.0, 0.2});
  const auto b = outcomes({0.4, 1.4, 2.9, 0.1});
  const Mean found = harm_difference(a, b);
  EXPECT_NEAR(found.value, 0.1, 1e-12);
  EXPECT_NEAR(found.high - found.low, 0.0, 1e-9);
  EXPECT_GT(expected(a).harm.high - expected(a).harm.low, 1.0);
  EXPECT_NEAR(harm_difference(b, a).value, -0.1, 1e-12);
}

TEST(MeanOutcome, RefusesTooFewAndWhatDoesNotPair) {
  EXPECT_THROW((void)expected(outcomes({1.0})), ContractViolation);
  EXPECT_THROW((void)harm_difference(outcomes({1.0, 2.0}), outcomes({1.0})), ContractViolation);
  EXPECT_THROW((void)mean(std::vector<double>{1.0, std::numeric_limits<double>::quiet_NaN()}),
               ContractViolation);
  EXPECT_THROW((void)student_t(0), ContractViolation);
}

}  // namespace
}  // namespace saca::forecast::expected_test

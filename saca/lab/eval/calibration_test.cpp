#include "saca/lab/eval/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::eval::calibration_test {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;

TEST(RightPolicies, AreAllThatTieWithTheBestPlan) {
  Comparison made;
  made.tried = {{Plan{PolicyId::aeb, std::nullopt}, 0.2, true},
                {Plan{PolicyId::aes_left, std::nullopt}, 0.0, false},
                {Plan{PolicyId::es_b_left, 5.0}, 0.4, true},
                {Plan{PolicyId::es_b_left, 10.0}, 0.0, false},  // another speed of the same
                {Plan{PolicyId::t_drift_left, std::nullopt}, std::nullopt, false}};
  made.best_harm = 0.0;
  RightPolicies wanted{};
  wanted[manoeuvre::index(PolicyId::aes_left)] = true;
  wanted[manoeuvre::index(PolicyId::es_b_left)] = true;
  EXPECT_EQ(right_policies(made), wanted);
  EXPECT_THROW((void)right_policies(Comparison{}), ContractViolation);
}

TEST(Temperature, LeavesTheOrderAndOneAsItIs) {
  const Probabilities p{0.4, 0.3, 0.1, 0.1, 0.05, 0.05, 0.0, 0.0};
  const Probabilities same = tempered(p, 1.0);
  const Probabilities soft = tempered(p, 4.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    EXPECT_NEAR(same[k], p[k], 1e-9);
    sum += soft[k];
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(soft[1] / soft[0], std::pow(0.75, 0.25), 1e-12);
  EXPECT_GT(tempered(p, 0.2)[0], 0.75);
}

TEST(LogLoss, CountsWhatAllThatAreRightWereGiven) {
  const std::vector<JudgedAnswer> judged{{{0.5, 0.25, 0.25}, {true, true}}, {{0.5, 0.5}, {true}}};
  EXPECT_NEAR(log_loss(judged, 1.0), -(std::log(0.75) + std::log(0.5)) / 2.0, 1e-9);
}

// Choices drawn from softened probabilities: the sharp ones are softened as much.
TEST(Temperature, IsFoundAgain) {
  std::mt19937 random(3);
  std::vector<JudgedAnswer> judged;
  for (int i = 0; i < 20'000; ++i) {
    Probabilities p{};
    double sum = 0.0;
    for (double& each : p) {
      each = std::exp(std::normal_distribution<double>(0.0, 2.0)(random));
      sum += each;
    }
    for (double& each : p) {
      each /= sum;
    }
    const Probabilities truth = tempered(p, 2.5);
    JudgedAnswer one{.said = p, .right = {}};
    one.right.at(std::discrete_distribution<std::size_t>(truth.begin(), truth.end())(random)) =
        true;
    judged.push_back(one);
  }
  const double best = best_temperature(judged);
  EXPECT_NEAR(best, 2.5, 0.15);  // 20,000 draws
  EXPECT_LT(log_loss(judged, best), log_loss(judged, 0.9 * best));
  EXPECT_LT(log_loss(judged, best), log_loss(judged, 1.1 * best));
}

// Always sure and always wrong: as soft as it goes, not beyond.
TEST(Temperature, HasEnds) {
  JudgedAnswer one{.said = {1.0}, .right = {false, true}};
  EXPECT_NEAR(best_temperature({&one, 1}), 20.0, 0.02);
  one.right = {true};
  one.said = {0.6, 0.4};
  EXPECT_NEAR(best_temperature({&one, 1}), 0.05, 5e-5);
}

}  // namespace
}  // namespace saca::eval::calibration_test

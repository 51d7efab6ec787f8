#include "saca/eval/choices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "saca/core/contract.h"

namespace saca::eval::choices_test {
namespace {

using manoeuvre::PolicyId;

/// Braking harms at 0.2, swerving to the left at 0.1, doing nothing at 0.5; nothing else can be
/// driven.
Finding finding() {
  Finding made{.family = "f", .time = 1.0, .best = PolicyId::aes_left};
  made.harm[0] = 0.2;
  made.harm[1] = 0.1;
  made.harm[7] = 0.5;
  made.contact[0] = made.contact[1] = made.contact[7] = true;
  return made;
}

/// Doing nothing harms nobody.
Finding quiet() {
  Finding made{.family = "f", .time = 1.0, .best = PolicyId::no_intervention};
  made.harm[0] = 0.0;
  made.harm[7] = 0.0;
  return made;
}

TEST(Choices, AreJudgedByWhatTheyLeadTo) {
  const std::vector<Finding> found{finding(), finding(), quiet(), quiet()};
  const ChoiceFigures figures =
      figures_of(found, std::vector{PolicyId::aes_left, PolicyId::t_drift_left,
                                    PolicyId::no_intervention, PolicyId::aeb});
  EXPECT_EQ(figures.count, 4);
  EXPECT_DOUBLE_EQ(figures.right.share, 0.5);
  EXPECT_NEAR(figures.harm.value, (0.1 + 0.2) / 4.0, 1e-12);  // the drift is refused: braking
  EXPECT_NEAR(figures.regret.value, (0.0 + 0.1) / 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(figures.contact.share, 0.5);
  EXPECT_EQ(figures.quiet, 2);
  EXPECT_EQ(figures.needless, 1);
  EXPECT_THROW((void)figures_of(found, std::vector{PolicyId::aeb}), ContractViolation);
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

// Choices drawn from softened probabilities: the sharp ones are softened as much.
TEST(Temperature, IsFoundAgain) {
  std::mt19937 random(3);
  std::vector<Finding> found;
  std::vector<Probabilities> said;
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
    Finding one;
    one.time = 1.0;
    one.best = manoeuvre::all_policies.at(
        std::discrete_distribution<std::size_t>(truth.begin(), truth.end())(random));
    found.push_back(one);
    said.push_back(p);
  }
  const double best = best_temperature(found, said);
  EXPECT_NEAR(best, 2.5, 0.15);  // 20,000 draws
  EXPECT_LT(log_loss(found, said, best), log_loss(found, said, 0.9 * best));
  EXPECT_LT(log_loss(found, said, best), log_loss(found, said, 1.1 * best));
}

// Always sure and always wrong: as soft as it goes, not beyond.
TEST(Temperature, HasEnds) {
  const std::vector<Finding> found{finding(), finding()};
  const std::vector<Probabilities> wrong(2, Probabilities{1.0});
  EXPECT_NEAR(best_temperature(found, wrong), 20.0, 1e-6);
  std::vector<Probabilities> right(2);
  right[0][1] = right[1][1] = 1.0;
  EXPECT_NEAR(best_temperature(found, right), 0.05, 1e-6);
}

}  // namespace
}  // namespace saca::eval::choices_test

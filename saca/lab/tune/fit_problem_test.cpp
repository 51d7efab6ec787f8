#include "saca/lab/tune/fit_problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/tune/fit_drive.h"

namespace saca::tune::fit_problem_test {
namespace {

class Problem : public testing::Test {
 protected:
  vehicle::Vehicle car_ = prepare::default_vehicle();
  std::vector<Log> logs_{drive_test(car_, {.kind = TestKind::steer, .turning = 1.0, .seed = 5})};
  FitProblem problem_{car_, 0.9, logs_};
  Eigen::VectorXd zero_ = Eigen::VectorXd::Zero(problem_.size());
};

TEST_F(Problem, FindsTheNoiseThatWasPutIn) {
  for (std::size_t k = 0; k < problem_.series().size(); ++k) {
    const SignalInfo& signal = info(logs_[0].measured[problem_.series()[k].column].signal);
    // A median of some 150 second differences, neighbours not independent: within 25 %.
    EXPECT_NEAR(problem_.noise()[k], signal.typical_noise, 0.25 * signal.typical_noise)
        << signal.column;
  }
}

TEST_F(Problem, AtTheTruthLeavesResidualsOfTheNoise) {
  const Eigen::VectorXd residuals = problem_.residuals(zero_);
  const Eigen::Index num_data = problem_.num_residuals() - problem_.size();
  const double mean_square = residuals.head(num_data).squaredNorm() / static_cast<double>(num_data);
  EXPECT_NEAR(mean_square, 1.0, 0.2);  // the noise's own estimate is that uncertain
  EXPECT_EQ(residuals.tail(problem_.size()).norm(), 0.0);
}

TEST_F(Problem, ValuesAndUnknownsAreInverse) {
  for (std::size_t k = 0; k < num_candidates; ++k) {
    EXPECT_NEAR(problem_.x_of(k, problem_.value(k, 0.3)), 0.3, 1e-12) << candidates()[k].key;
    EXPECT_GE(problem_.value(k, -100.0), candidates()[k].least);
    EXPECT_LE(problem_.value(k, 100.0), candidates()[k].most);
  }
}

// Offsets enter linearly: their slope is known in closed form.
TEST_F(Problem, SlopeOfAnOffsetIsItsSdOverTheNoise) {
  const FitProblem::Place& place = problem_.series()[1];
  const Eigen::MatrixXd slopes = problem_.jacobian(zero_, {place.unknown});
  const SignalInfo& signal = info(logs_[0].measured[place.column].signal);
  const Eigen::VectorXd residuals = problem_.residuals(zero_);
  for (Eigen::Index row = place.first; row < place.first + 50; ++row) {
    if (std::abs(residuals[row]) < 2.9) {  // beyond 3 it is bent
      EXPECT_NEAR(slopes(row, 0), -signal.offset_sd / problem_.noise()[1], 1e-6);
    }
  }
  EXPECT_NEAR(slopes(problem_.num_residuals() - problem_.size() + place.unknown, 0), 1.0, 1e-9);
}

TEST_F(Problem, WhatTheLogsDoNotAskKeepsTheSdThatItHadBefore) {
  const Eigen::MatrixXd covariance = problem_.covariance(zero_);
  EXPECT_NEAR(covariance(6, 6), 1.0, 1e-6);  // brakes, in a step steer
  EXPECT_NEAR(covariance(7, 7), 1.0, 1e-6);
  EXPECT_LT(covariance(1, 1), 0.05);  // the tyre's stiffness
}

}  // namespace
}  // namespace saca::tune::fit_problem_test

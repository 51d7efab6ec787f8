#include "saca/lab/network_training/danger_losses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace saca::network_training::danger_losses_test {
namespace {

using torch::Tensor;

// A value of 0 m counts 0.05 + 1, one of 3 m 0.05 + 1/2.
constexpr double weight_at_0 = 1.05;
constexpr double weight_at_3 = 0.55;

Tensor one(double value) {
  return torch::full({1}, value);
}

/// Networks that say nothing but these numbers.
NetworkValues saying(double v, double slow_q) {
  return {.v = one(v),
          .q = {one(0.0), one(0.0)},
          .slow_q = one(slow_q),
          .next_v = one(-1.5),
          .next_h = one(-2.0)};
}

/// A transition after which all is settled.
TransitionSample settled() {
  return {.h = one(-1.0), .settled = one(1.0), .reached = one(5.0)};
}

// The expectile is reversed: V above Q costs 99 times what V below it does.
TEST(DangerLosses, DrawVToTheLowerEndOfQ) {
  const StepSettings now{.expectile = 0.99, .discount = 1.0};
  EXPECT_NEAR(losses_of(saying(0.0, 1.0), settled(), now).told.v_loss, weight_at_0 * 0.01, 1e-6);
  EXPECT_NEAR(losses_of(saying(0.0, -1.0), settled(), now).told.v_loss, weight_at_0 * 0.99, 1e-6);
}

// What is to be made small beyond 2 m is linear: 2 (2 * 3 - 2) of 3 m.
TEST(DangerLosses, AreLinearFarAway) {
  const StepSettings now{.expectile = 0.5, .discount = 1.0};
  EXPECT_NEAR(losses_of(saying(3.0, 0.0), settled(), now).told.v_loss, weight_at_3 * 0.5 * 8.0,
              1e-5);
}

TEST(DangerLosses, BoundQByWhatADriveReached) {
  const StepSettings now{.expectile = 0.99, .discount = 1.0};
  // Settled: the deepest of h on the way, -1 m, and h at the end.
  EXPECT_NEAR(losses_of(saying(0.0, 0.0), settled(), now).told.q_loss, 2.0 * weight_at_0, 1e-5);
  TransitionSample goes_on = settled();
  goes_on.settled = one(0.0);
  NetworkValues said = saying(0.0, 0.0);
  said.next_v = one(-0.5);
  EXPECT_NEAR(losses_of(said, goes_on, now).told.q_loss, 2.0 * weight_at_0 * 0.25, 1e-5);
  // Half forgotten: between h and what comes.
  EXPECT_NEAR(losses_of(said, goes_on, {.expectile = 0.99, .discount = 0.5}).told.q_loss,
              2.0 * weight_at_0 * 0.75 * 0.75, 1e-5);
  goes_on.reached = one(-1.0);
  EXPECT_NEAR(losses_of(said, goes_on, now).told.q_loss, 2.0 * weight_at_0, 1e-5);
}

TEST(DangerLosses, OfOutcomesLeaveOutEndsThatWereNotSeen) {
  NetworkValues said = saying(0.0, 0.0);
  said.v = torch::zeros({2});
  TransitionSample sample = settled();
  sample.reached = torch::tensor({-1.0F, std::numeric_limits<float>::infinity()});
  const Losses losses = outcome_losses(said, sample, {});
  EXPECT_NEAR(losses.sum.item<double>(), 0.5 * weight_at_0, 1e-6);
  EXPECT_NEAR(losses.told.above, 0.5, 1e-6) << "one lies 0.2 m above what was reached";
}

TEST(DangerLosses, OfAStepOfPolicyIterationAreOfQAlone) {
  NetworkValues said = saying(0.0, 0.0);
  said.next_v = one(1.0);
  TransitionSample sample = settled();
  sample.settled = one(0.0);
  const Losses losses = improving_losses(said, sample, {});
  EXPECT_NEAR(losses.sum.item<double>(), 2.0 * weight_at_0, 1e-5);
  EXPECT_EQ(losses.told.v_loss, 0.0);
}

// Both networks add 0.5 m to h. The better of two inputs comes to -2 m, and so does V.
TEST(DangerLosses, OfFittedIterationTakeTheBestInput) {
  FittedNets nets(4);
  {
    const torch::NoGradGuard none;
    for (Tensor& weights : nets->parameters()) {
      weights.zero_();
    }
    for (const char* const bias : {"v.last.bias", "slow_v.last.bias"}) {
      nets->named_parameters()[bias].fill_(std::log(std::expm1(0.5)));
    }
  }
  OutcomeSample sample{.inputs = torch::zeros({1, num_inputs}),
                       .h_at = one(-2.5),
                       .next_inputs = torch::zeros({2, num_inputs}),
                       .next_h_at = torch::tensor({-1.0F, -2.0F}),
                       .h = torch::tensor({-3.0F, -3.0F}),
                       .settled = torch::tensor({0.0F, 1.0F})};
  EXPECT_NEAR(fitted_losses(nets, sample, {}).sum.item<double>(), 0.0, 1e-6);
  sample.h_at = one(-0.5);  // V is 0, 2 m too high
  EXPECT_NEAR(fitted_losses(nets, sample, {}).sum.item<double>(), weight_at_0 * 4.0, 1e-4);
}

// Of two Q the larger is taken, and h of the nearest of two obstacles.
TEST(DangerLosses, AreOfTheLargerQAndTheNearestObstacle) {
  torch::manual_seed(6);
  DangerNets singles(num_inputs, 4);
  TransitionSample sample{.inputs = torch::randn({2, num_inputs}),
                          .next_inputs = torch::randn({2, num_inputs}),
                          .actions = torch::zeros({2, num_actions}),
                          .h_at = torch::tensor({-3.0F, -2.0F}),
                          .next_h_at = torch::tensor({-4.0F, -1.0F})};
  const NetworkValues said = said_by(singles, sample);
  EXPECT_TRUE(torch::allclose(said.slow_q, torch::maximum(said.q[0], said.q[1])));
  EXPECT_TRUE(torch::equal(said.next_h, sample.next_h_at));

  DangerNets pairs(static_cast<std::int64_t>(learned_danger::num_pair_inputs), 4);
  sample.actions = torch::zeros({1, num_actions});
  const NetworkValues both = said_by(pairs, singles, sample);
  EXPECT_EQ(both.next_h.item<double>(), -1.0);
  EXPECT_GE(both.v.item<double>(), said.v.max().item<double>()) << "two are no less than each";
}

}  // namespace
}  // namespace saca::network_training::danger_losses_test

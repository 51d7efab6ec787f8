#include "saca/lab/network_training/danger_nets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "saca/lab/learned_danger/network.h"

namespace saca::network_training::danger_nets_test {
namespace {

constexpr auto pair_inputs = static_cast<std::int64_t>(learned_danger::num_pair_inputs);

/// One whose last bias says what it adds to h, whatever it reads.
DangerNet adding(double added) {
  DangerNet net(num_inputs, 4);
  const torch::NoGradGuard none;
  for (torch::Tensor& weights : net->parameters()) {
    weights.zero_();
  }
  net->named_parameters()["last.bias"].fill_(std::log(std::expm1(added)));  // softplus of it
  return net;
}

TEST(DangerNets, AddAtLeastNothingToH) {
  torch::manual_seed(2);
  DangerNet net(num_inputs, 8);
  const torch::NoGradGuard none;
  const torch::Tensor h = torch::full({50}, -3.0);
  EXPECT_GE((net(10.0 * torch::randn({50, num_inputs}), h) - h).min().item<double>(), 0.0);
  EXPECT_NEAR(adding(0.7)(torch::randn({1, num_inputs}), torch::full({1}, -2.0)).item<double>(),
              -1.3, 1e-6);
}

TEST(DangerNets, ComeBackFromTheirWeights) {
  torch::manual_seed(3);
  DangerNet net(num_inputs, 5);
  formats::Tensors tensors;
  net->add_to(tensors, "v.");
  DangerNet again = danger_net(tensors, "v.");
  const torch::NoGradGuard none;
  const torch::Tensor inputs = torch::randn({7, num_inputs});
  EXPECT_TRUE(torch::equal(net->added(inputs), again->added(inputs)));
}

TEST(DangerNets, FollowByAShareOfTheWay) {
  DangerNet slow = adding(1.0);
  const DangerNet fast = adding(2.0);
  const auto bias = [](const DangerNet& net) {
    return net->named_parameters()["last.bias"].item<double>();
  };
  const double expected = 0.75 * bias(slow) + 0.25 * bias(fast);
  follow(slow, fast, 0.25);
  EXPECT_NEAR(bias(slow), expected, 1e-6);
  follow(slow, fast, 1.0);
  EXPECT_EQ(bias(slow), bias(fast));
}

// Of two obstacles the one whose V is higher comes first, whichever it was, and the other counts
// from -10 m to -5 m.
TEST(DangerNets, SeeTheMoreDangerousOfTwoFirst) {
  DangerNets singles(num_inputs, 4);
  follow(singles->v, adding(1.0), 1.0);
  torch::Tensor rows = torch::zeros({4, num_inputs});
  rows.select(0, 0).fill_(0.1);
  rows.select(0, 1).fill_(0.2);
  rows.select(0, 2).fill_(0.3);
  rows.select(0, 3).fill_(0.4);
  const torch::Tensor h = torch::tensor({-9.0F, -2.0F, -1.0F, -9.5F});
  const PairInputs seen = seen_as_pair(singles, rows, h);
  ASSERT_EQ(seen.inputs.size(1), pair_inputs);
  EXPECT_NEAR(seen.inputs[0][0].item<double>(), 0.2, 1e-7);
  EXPECT_NEAR(seen.inputs[0][num_inputs].item<double>(), 0.1, 1e-7);
  EXPECT_NEAR(seen.inputs[1][0].item<double>(), 0.3, 1e-7);
  EXPECT_NEAR(seen.v[0].item<double>(), -1.0, 1e-5);
  EXPECT_NEAR(seen.v[1].item<double>(), 0.0, 1e-5);
  EXPECT_NEAR(seen.share[0].item<double>(), 0.4, 1e-5) << "V of the other is -8 m";
  EXPECT_NEAR(seen.share[1].item<double>(), 0.3, 1e-5) << "V of the other is -8.5 m";
  EXPECT_NEAR(seen.inputs[0][pair_inputs - 2].item<double>(), 0.2 * -1.0, 1e-5);
  EXPECT_NEAR(seen.inputs[0][pair_inputs - 1].item<double>(), 0.2 * -8.0, 1e-5);
}

TEST(DangerNets, TellValuesOfWhatIsSeenNoLowerThanIsTold) {
  DangerNet net = adding(0.5);
  std::array<learned_danger::SeenByNet, 2> seen;
  seen[0].h = -3.0;
  seen[1].h = -40.0;
  const std::vector<double> values = values_of(net, seen);
  ASSERT_EQ(values.size(), 2U);
  EXPECT_NEAR(values[0], -2.5, 1e-5);
  EXPECT_NEAR(values[1], -learned_danger::farthest_told + 0.5, 1e-5);
}

// What the product works out from the weights is what was trained.
TEST(DangerNets, AreTheNetworkThatTheProductRuns) {
  torch::manual_seed(4);
  constexpr auto width = static_cast<std::int64_t>(learned_danger::Network::width);
  DangerNets nets(static_cast<std::int64_t>(learned_danger::num_net_inputs), width);
  DangerNets pairs(static_cast<std::int64_t>(learned_danger::num_pair_inputs), width);
  formats::Tensors tensors;
  nets->add_to(tensors, "");
  pairs->add_to(tensors, "pair_");
  const auto network = learned_danger::Network::from(tensors, "weights");
  ASSERT_TRUE(network.has_value()) << network.error().message;
  ASSERT_TRUE(network.value().knows_pairs());
  std::array<learned_danger::SeenByNet, 2> seen;
  seen[0].h = -3.0;
  seen[0].inputs.fill(0.3F);
  seen[1].h = -2.5;
  seen[1].inputs.fill(-0.2F);
  const manoeuvre::Demand demand{-0.5, 0.2};
  std::array<double, 1> q{};
  network.value().joint_values_of(std::span(seen).first(1), {&demand, 1}, q);
  const torch::NoGradGuard none;
  const torch::Tensor inputs =
      torch::full({1, static_cast<std::int64_t>(learned_danger::num_net_inputs)}, 0.3);
  const torch::Tensor h = torch::full({1}, -3.0);
  EXPECT_NEAR(network.value().joint_value(std::span(seen).first(1)),
              nets->v(inputs, h).item<double>(), 1e-4);
  const torch::Tensor both = torch::cat({inputs, torch::tensor({{-0.5F, 0.2F}})}, 1);
  EXPECT_NEAR(q[0], torch::maximum(nets->q1(both, h), nets->q2(both, h)).item<double>(), 1e-4);

  const torch::Tensor rows = torch::cat({inputs, torch::full_like(inputs, -0.2)}, 0);
  const torch::Tensor h_of_both = torch::tensor({-3.0F, -2.5F});
  EXPECT_NEAR(network.value().joint_value(seen), joint_value(nets, pairs, rows, h_of_both), 1e-4);
}

}  // namespace
}  // namespace saca::network_training::danger_nets_test

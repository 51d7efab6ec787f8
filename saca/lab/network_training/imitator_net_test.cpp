#include "saca/lab/network_training/imitator_net.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/base/formats/tensors.h"

namespace saca::network_training::imitator_net_test {
namespace {

using manoeuvre::PolicyId;

const auto every_epoch = [](const Epoch&) { return true; };

/// A free road with somebody 20 m ahead who stands d to the left; the best is to pass on the other
/// side, and from the mirror image of it the other way round.
memory::Case passing(double d) {
  memory::Case one;
  one.scene.ego_footprint = {.length = 4.5, .width = 1.8};
  one.scene.ego_mass = 1500.0;
  one.scene.grip = 0.8;
  one.scene.ego.v_B = {15.0, 0.0};
  one.scene.actors.push_back({.id = 1,
                              .footprint = {.length = 4.5, .width = 1.8},
                              .mass = 1500.0,
                              .X_WA = {{20.0, d}, 0.0}});
  one.best = d > 0.0 ? PolicyId::aes_right : PolicyId::aes_left;
  return one;
}

std::vector<memory::Case> to_one_side(int count, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> any(0.3, 1.5);
  std::vector<memory::Case> cases;
  for (int i = 0; i < count; ++i) {
    cases.push_back(passing(any(rng)));
  }
  return cases;
}

Schedule quick() {
  return {.seed = 3, .epochs = 40, .batch = 40, .step = 1e-2};
}

eval::Imitator imitator_of(const ImitatorNet& network) {
  return eval::Imitator::from(network->tensors(), "net").value();
}

// What the product computes from the weights is what was trained.
TEST(ImitatorNet, IsTheNetworkThatChooses) {
  torch::manual_seed(5);
  ImitatorNet network(0.0);
  network->eval();
  const memory::Case one = passing(0.7);
  const auto inputs = eval::imitator_inputs(one.scene);
  const torch::Tensor log_p =
      network->log_probabilities(torch::tensor(std::vector<float>(inputs.begin(), inputs.end())));
  const auto p = imitator_of(network).probabilities(one.scene);
  for (std::size_t k = 0; k < p.size(); ++k) {
    EXPECT_NEAR(p[k], std::exp(log_p[static_cast<std::int64_t>(k)].item<double>()), 1e-6) << k;
  }
  const auto pieces = imitator_pieces({&one, 1});
  EXPECT_NEAR(network->loss(batch_of({pieces.data()})).item<double>(),
              -std::log(p[manoeuvre::index(one.best)]), 1e-5);
}

// It learns from one side what to do on the other.
TEST(ImitatorNet, LearnsWhatWasDone) {
  const auto network =
      trained_imitator(imitator_pieces(to_one_side(200, 1)), {}, quick(), 0.0, "", every_epoch);
  ASSERT_TRUE(network.has_value());
  const eval::Imitator imitator = imitator_of(network.value());
  for (const double d : {0.4, 1.0, 1.4}) {
    EXPECT_EQ(imitator.choice(passing(d).scene), PolicyId::aes_right) << d;
    EXPECT_EQ(imitator.choice(passing(-d).scene), PolicyId::aes_left) << d;
  }
}

TEST(ImitatorNet, SameSeedSameBytes) {
  const auto pieces = imitator_pieces(to_one_side(50, 1));
  const auto bytes = [&](std::uint64_t seed) {
    Schedule schedule = quick();
    schedule.seed = seed;
    schedule.epochs = 3;
    return formats::tensor_bytes(
        trained_imitator(pieces, {}, schedule, 0.1, "", every_epoch).value()->tensors());
  };
  EXPECT_EQ(bytes(1), bytes(1));
  EXPECT_NE(bytes(1), bytes(2));
}

}  // namespace
}  // namespace saca::network_training::imitator_net_test

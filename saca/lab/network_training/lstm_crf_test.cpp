#include "saca/lab/network_training/lstm_crf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/network_training/training.h"
#include "saca/thinking/intent/crf.h"
#include "saca/thinking/intent/model.h"

namespace saca::network_training::lstm_crf_test {
namespace {

using intent::num_classes;
using intent::num_features;
using intent::num_horizons;

constexpr std::int64_t frames = 12;

/// Two pieces, the second shorter.
Batch random_batch() {
  torch::manual_seed(3);
  std::vector<Piece> pieces;
  for (const std::int64_t length : {frames, frames - 5}) {
    pieces.push_back({torch::randn({length, static_cast<std::int64_t>(num_features)}),
                      torch::randint(0, 6, {length, 3}),
                      torch::rand({length, 3}) < 0.2,
                      {}});
  }
  for (Piece& piece : pieces) {  // labels that the structural mask allows: all of one side
    piece.labels = piece.labels % 2 * 3;
  }
  return batch_of({&pieces[0], &pieces[1]});
}

/// The chain of one horizon as intent has it.
intent::Crf chain_of(const LstmCrf& network, std::int64_t h) {
  intent::Crf crf;
  for (std::size_t j = 0; j < num_classes; ++j) {
    const auto row = static_cast<std::int64_t>(j);
    crf.start[j] = network->start()[h][row].item<double>();
    for (std::size_t k = 0; k < num_classes; ++k) {
      crf.transition[j][k] =
          intent::may_follow(j, k)
              ? network->transition()[h][row][static_cast<std::int64_t>(k)].item<double>()
              : intent::forbidden;
    }
  }
  return crf;
}

TEST(LstmCrf, LossIsOfWhatAStreamIsTold) {
  torch::manual_seed(7);
  LstmCrf network(0.0);
  const Batch batch = random_batch();
  const torch::Tensor emissions = 3.0 * torch::randn({2, frames, 3, 6});
  const ClassWeights weights{1.0, 5.0, 0.5, 3.0, 7.0, 2.0};
  const torch::Tensor loss = network->loss(emissions, batch);
  const torch::Tensor weighted = network->loss(emissions, batch, weights);
  double filtered = 0.0;
  double weighted_sum = 0.0;
  double weight = 0.0;
  for (std::int64_t i = 0; i < 2; ++i) {
    const std::int64_t length = batch.present[i].sum().item<std::int64_t>();
    for (std::int64_t h = 0; h < 3; ++h) {
      std::vector<intent::Scores> scores(static_cast<std::size_t>(length));
      const intent::Crf crf = chain_of(network, h);
      intent::CrfFilter filter;
      for (std::int64_t t = 0; t < length; ++t) {
        const auto row = static_cast<std::size_t>(t);
        for (std::size_t k = 0; k < num_classes; ++k) {
          scores[row][k] = emissions[i][t][h][static_cast<std::int64_t>(k)].item<double>();
        }
        const intent::Scores& now = filter.step(crf, scores[row]);
        if (batch.known[i][t][h].item<bool>()) {
          const auto label = static_cast<std::size_t>(batch.labels[i][t][h].item<std::int64_t>());
          filtered += std::log(now[label]);
          weighted_sum += weights[label] * std::log(now[label]);
          weight += weights[label];
        }
      }
    }
  }
  const double num_known = batch.known.sum().item<double>();
  EXPECT_NEAR(loss.item<double>(), -filtered / num_known, 1e-4);  // float
  EXPECT_NEAR(weighted.item<double>(), -weighted_sum / weight, 1e-4);
}

TEST(LstmCrf, WhatIsTaughtOfALabelIsItsCrossEntropy) {
  torch::manual_seed(17);
  LstmCrf network(0.0);
  Batch batch = random_batch();
  const torch::Tensor emissions = 3.0 * torch::randn({2, frames, 3, 6});
  const ClassWeights weights{1.0, 5.0, 0.5, 3.0, 7.0, 2.0};
  const float by_labels = network->loss(emissions, batch, weights).item<float>();
  batch.taught = torch::one_hot(batch.labels, 6).to(torch::kFloat32);
  EXPECT_FLOAT_EQ(network->loss(emissions, batch, weights).item<float>(), by_labels);
  // Half of each label, half of what comes after it: the mean of both losses, each frame counting
  // as its label does.
  Batch other = batch;
  other.taught = batch.taught.roll(1, -1);
  const float by_others = network->loss(emissions, other, weights).item<float>();
  EXPECT_GT(std::abs(by_others - by_labels), 0.1F);
  batch.taught = 0.5 * (batch.taught + other.taught);
  EXPECT_NEAR(network->loss(emissions, batch, weights).item<float>(),
              0.5F * (by_labels + by_others), 1e-4F);
}

TEST(LstmCrf, EmissionsAreThoseOfTheNetworkThatIsWritten) {
  torch::manual_seed(11);
  LstmCrf network(0.3);
  network->eval();
  const torch::NoGradGuard no_gradients;
  const torch::Tensor features = torch::randn({1, 20, static_cast<std::int64_t>(num_features)});
  const torch::Tensor told = network->emissions(features);
  formats::Tensors tensors;
  network->add_network(tensors, "0.");
  const auto written = intent::Network::from(tensors, "0.", "w");
  ASSERT_TRUE(written.has_value()) << written.error().message;
  intent::Network::State state;
  for (std::int64_t t = 0; t < 20; ++t) {
    intent::Features seen;
    for (std::size_t i = 0; i < num_features; ++i) {
      seen[i] = features[0][t][static_cast<std::int64_t>(i)].item<float>();
    }
    const intent::Emissions now = written.value().step(seen, state);
    for (std::size_t h = 0; h < num_horizons; ++h) {
      for (std::size_t k = 0; k < num_classes; ++k) {
        EXPECT_NEAR(
            now[h][k],
            told[0][t][static_cast<std::int64_t>(h)][static_cast<std::int64_t>(k)].item<double>(),
            1e-4);  // float, other orders of summation
      }
    }
  }
}

TEST(LstmCrf, WhatIsFilledUpChangesNothing) {
  torch::manual_seed(13);
  LstmCrf network(0.0);
  const Batch batch = random_batch();
  const torch::Tensor emissions = torch::randn({2, frames, 3, 6});
  torch::Tensor other = emissions.clone();
  other[1].narrow(0, frames - 5, 5).fill_(9.0);
  EXPECT_EQ(network->loss(emissions, batch).item<float>(),
            network->loss(other, batch).item<float>());
}

}  // namespace
}  // namespace saca::network_training::lstm_crf_test

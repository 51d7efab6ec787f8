#include "saca/learn/foretell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/intent/network_for_test.h"

namespace saca::learn::foretell_test {
namespace {

/// One sequence whose labels are drawn from `true_probability` of the first class, and forecasts
/// that say `told` of it: all horizons alike.
struct Drawn {
  Sequence sequence;
  Forecasts forecasts;
};

Drawn drawn(double true_probability, double told, std::size_t size) {
  std::mt19937 random(5);
  std::bernoulli_distribution first(true_probability);
  Drawn result;
  const double rest = (1.0 - told) / 5.0;
  for (std::size_t i = 0; i < size; ++i) {
    result.sequence.observations.emplace_back();
    result.sequence.labels.push_back(first(random) ? 0 : static_cast<std::uint8_t>(1 + i % 5));
    result.sequence.scored.push_back(true);
    for (auto& head : result.forecasts.at) {
      head.push_back({told, rest, rest, rest, rest, rest});
    }
  }
  return result;
}

TEST(Sharpness, OfTooSureForecastsIsBelowOne) {
  const Drawn one = drawn(0.8, 0.95, 20'000);
  const auto found = best_sharpness(std::span(&one.sequence, 1), std::span(&one.forecasts, 1));
  // The odds of the first class against each other one, 0.95 / 0.01, are to become 0.8 / 0.04.
  const double expected = std::log(0.8 / 0.04) / std::log(0.95 / 0.01);
  for (const double each : found) {
    EXPECT_NEAR(each, expected, 0.02);  // sampling: 20,000 labels
  }
}

TEST(Sharpness, OfHonestForecastsIsOne) {
  const Drawn one = drawn(0.7, 0.7, 20'000);
  for (const double each :
       best_sharpness(std::span(&one.sequence, 1), std::span(&one.forecasts, 1))) {
    EXPECT_NEAR(each, 1.0, 0.03);
  }
}

TEST(Foretold, IsWhatAStreamTellsFrameByFrame) {
  config::Tensors tensors;
  intent::add_random_network(tensors, "", 3);
  intent::Model model;
  model.networks.push_back(intent::Network::from(tensors, "", "w").value());
  std::vector<Sequence> sequences(3);
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    for (std::size_t t = 0; t < 10 + i; ++t) {
      sequences[i].observations.push_back({.speed = 10.0 + static_cast<double>(t * i),
                                           .offset = 0.1,
                                           .lateral_speed = 0.0,
                                           .heading = 0.0,
                                           .lane_width = 3.5});
    }
  }
  const auto all = foretold(model, sequences, 2);
  ASSERT_EQ(all.size(), 3U);
  intent::Stream stream;
  for (std::size_t t = 0; t < sequences[2].observations.size(); ++t) {
    const intent::Told told = stream.step(model, sequences[2].observations[t]);
    for (std::size_t head = 0; head < num_heads; ++head) {
      EXPECT_EQ(all[2].at[head][t], told[head]);
    }
  }
}

}  // namespace
}  // namespace saca::learn::foretell_test

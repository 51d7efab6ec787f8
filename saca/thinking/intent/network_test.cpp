#include "saca/thinking/intent/network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/thinking/intent/network_for_test.h"

namespace saca::intent::network_test {
namespace {

constexpr std::size_t w = Network::width;

/// The formulas of the header, one number after the other, in double.
struct SlowNetwork {
  formats::Tensors tensors;
  std::vector<double> h = std::vector<double>(w, 0.0);
  std::vector<double> c = std::vector<double>(w, 0.0);

  [[nodiscard]] std::vector<double> layer(const std::string& name,
                                          const std::vector<double>& x) const {
    const auto& weight = tensors.tensors.at(name + ".weight").values;
    std::vector<double> y;
    for (const float bias : tensors.tensors.at(name + ".bias").values) {
      double sum = static_cast<double>(bias);
      for (std::size_t i = 0; i < x.size(); ++i) {
        sum += static_cast<double>(weight[y.size() * x.size() + i]) * x[i];
      }
      y.push_back(sum);
    }
    return y;
  }

  std::vector<double> step(const Features& features) {
    std::vector<double> u = layer("input", {features.begin(), features.end()});
    for (double& each : u) {
      each = std::tanh(each);
    }
    std::vector<double> both = u;
    both.insert(both.end(), h.begin(), h.end());
    const std::vector<double> gates = layer("lstm", both);
    const auto sigmoid = [](double x) { return 1.0 / (1.0 + std::exp(-x)); };
    for (std::size_t i = 0; i < w; ++i) {
      c[i] = sigmoid(gates[w + i]) * c[i] + sigmoid(gates[i]) * std::tanh(gates[2 * w + i]);
      h[i] = sigmoid(gates[3 * w + i]) * std::tanh(c[i]);
    }
    both = h;
    both.insert(both.end(), u.begin(), u.end());
    return layer("output", both);
  }
};

std::vector<Features> random_features(std::uint32_t seed, std::size_t num) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0.0F, 1.0F);
  std::vector<Features> found(num);
  for (Features& each : found) {
    for (float& x : each) {
      x = normal(random);
    }
  }
  return found;
}

TEST(Network, ComputesTheFormulasOfItsHeader) {
  formats::Tensors tensors;
  add_random_network(tensors, "", 11);
  const auto network = Network::from(tensors, "", "w");
  ASSERT_TRUE(network.has_value()) << network.error().message;
  SlowNetwork world{tensors};
  SlowNetwork mirror{tensors};
  Network::State state;
  for (const Features& features : random_features(1, 60)) {
    const Emissions found = network.value().step(features, state);
    const std::vector<double> here = world.step(features);
    const std::vector<double> there = mirror.step(mirrored(features));
    for (std::size_t h = 0; h < num_horizons; ++h) {
      for (std::size_t k = 0; k < num_classes; ++k) {
        constexpr std::array<std::size_t, num_classes> other{0, 2, 1, 3, 5, 4};
        const double expected =
            0.5 * (here[h * num_classes + k] + there[h * num_classes + other[k]]);
        EXPECT_NEAR(found[h][k], expected, 2e-5);  // float against double, 60 steps
      }
    }
  }
}

TEST(Network, TellsTheMirrorImageOfAMirroredWorld) {
  formats::Tensors tensors;
  add_random_network(tensors, "a.", 5);
  const auto network = Network::from(tensors, "a.", "w");
  ASSERT_TRUE(network.has_value());
  Network::State state;
  Network::State mirror_state;
  for (const Features& features : random_features(2, 20)) {
    const Emissions here = network.value().step(features, state);
    const Emissions there = network.value().step(mirrored(features), mirror_state);
    for (std::size_t h = 0; h < num_horizons; ++h) {
      EXPECT_EQ(mirrored(here[h]), there[h]);
    }
  }
}

TEST(Network, RefusesTensorsOfOtherShapes) {
  formats::Tensors tensors;
  add_random_network(tensors, "", 1);
  tensors.tensors["lstm.bias"].shape = {3};
  EXPECT_THAT(Network::from(tensors, "", "file").error().message,
              testing::HasSubstr("file: tensor lstm.bias: want a shape of [192], got [3]"));
  EXPECT_THAT(Network::from(tensors, "b.", "file").error().message,
              testing::HasSubstr("want a tensor b.input.weight"));
}

}  // namespace
}  // namespace saca::intent::network_test

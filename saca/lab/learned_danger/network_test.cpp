#include "saca/lab/learned_danger/network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "saca/lab/learned_danger/random.h"
#include "tests/support/count_allocations.h"

namespace saca::learned_danger::network_test {
namespace {

using manoeuvre::Demand;

formats::Tensors drawn_tensors(Random& random) {
  formats::Tensors all;
  const auto add = [&](const std::string& name, std::size_t inputs) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t rows = k < 3 ? Network::width : 1;
      const std::size_t columns = k > 0 ? Network::width : inputs;
      const double most = std::sqrt(3.0 / static_cast<double>(columns));
      formats::Tensor weight{{rows, columns}, {}};
      formats::Tensor bias{{rows}, {}};
      for (std::size_t i = 0; i < rows * columns; ++i) {
        weight.values.push_back(static_cast<float>(uniform(random, -most, most)));
      }
      for (std::size_t i = 0; i < rows; ++i) {
        bias.values.push_back(static_cast<float>(uniform(random, -0.5, 0.5)));
      }
      all.tensors[name + std::to_string(k) + ".weight"] = weight;
      all.tensors[name + std::to_string(k) + ".bias"] = bias;
    }
  };
  add("v.", num_net_inputs);
  add("q1.", num_net_inputs + 2);
  add("q2.", num_net_inputs + 2);
  add("pair_v.", num_pair_inputs);
  add("pair_q1.", num_pair_inputs + 2);
  add("pair_q2.", num_pair_inputs + 2);
  all.words["car"] = "any";
  return all;
}

SeenByNet drawn_seen(Random& random) {
  SeenByNet seen;
  for (float& input : seen.inputs) {
    input = static_cast<float>(uniform(random, -2.0, 2.0));
  }
  seen.h = uniform(random, -20.0, 2.0);
  return seen;
}

/// What a network adds to h, written down anew: row by row, in double precision.
double added(const formats::Tensors& all, const std::string& name, std::vector<double> x) {
  for (int k = 0; k < 4; ++k) {
    const formats::Tensor& weight = all.tensors.at(name + std::to_string(k) + ".weight");
    const formats::Tensor& bias = all.tensors.at(name + std::to_string(k) + ".bias");
    std::vector<double> y(bias.values.begin(), bias.values.end());
    for (std::size_t row = 0; row < y.size(); ++row) {
      for (std::size_t column = 0; column < x.size(); ++column) {
        y[row] += static_cast<double>(weight.values[row * x.size() + column]) * x[column];
      }
      y[row] = k < 3 ? std::max(0.0, y[row]) : y[row];
    }
    x = y;
  }
  return std::log1p(std::exp(x[0]));
}

std::vector<double> inputs_of(const SeenByNet& seen) {
  return {seen.inputs.begin(), seen.inputs.end()};
}

class NetworkTest : public testing::Test {
 protected:
  Random random_{2};
  const formats::Tensors tensors_ = drawn_tensors(random_);
  const Network network_ = Network::from(tensors_, "weights").value();
};

TEST_F(NetworkTest, IsWhatItsLayersSayHoweverManyAreAsked) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{32}, std::size_t{33}, std::size_t{70}}) {
    std::vector<SeenByNet> seen(count);
    std::generate(seen.begin(), seen.end(), [&] { return drawn_seen(random_); });
    std::vector<double> v(count);
    network_.values(seen, v);
    for (std::size_t i = 0; i < count; ++i) {
      const double h = std::max(-15.0, seen[i].h);
      EXPECT_NEAR(v[i], h + added(tensors_, "v.", inputs_of(seen[i])), 1e-4);
      EXPECT_GE(v[i], h);
    }
  }
}

TEST_F(NetworkTest, TakesTheLargerOfTwoQ) {
  const SeenByNet seen = drawn_seen(random_);
  std::vector<Demand> demands(40);
  for (Demand& demand : demands) {
    demand = {uniform(random_, -0.7, 0.7), uniform(random_, -0.7, 0.7)};
  }
  std::vector<double> q(demands.size());
  network_.joint_values_of({&seen, 1}, demands, q);
  int second = 0;
  for (std::size_t i = 0; i < demands.size(); ++i) {
    std::vector<double> inputs = inputs_of(seen);
    inputs.insert(inputs.end(), {demands[i].along, demands[i].across});
    const double one = added(tensors_, "q1.", inputs);
    const double two = added(tensors_, "q2.", inputs);
    EXPECT_NEAR(q[i], std::max(-15.0, seen.h) + std::max(one, two), 1e-4);
    second += two > one ? 1 : 0;
  }
  EXPECT_EQ(Network::from(tensors_, "weights").value().words().at("car"), "any");
}

/// V of each by itself, then of two by the definition of a pair.
double pair_value(const formats::Tensors& tensors, const SeenByNet& a, const SeenByNet& b) {
  const auto single = [&](const SeenByNet& one) {
    return std::max(-15.0, one.h) + added(tensors, "v.", inputs_of(one));
  };
  const SeenByNet& one = single(a) >= single(b) ? a : b;
  const SeenByNet& other = single(a) >= single(b) ? b : a;
  std::vector<double> inputs = inputs_of(one);
  const std::vector<double> more = inputs_of(other);
  inputs.insert(inputs.end(), more.begin(), more.end());
  inputs.insert(inputs.end(), {single(one) / 5.0, single(other) / 5.0});
  const double share = std::clamp((single(other) + 10.0) / 5.0, 0.0, 1.0);
  return single(one) + share * added(tensors, "pair_v.", inputs);
}

TEST_F(NetworkTest, AddsWhatTwoObstaclesAre) {
  std::array<SeenByNet, 3> seen{drawn_seen(random_), drawn_seen(random_), drawn_seen(random_)};
  seen[0].h = -3.0;
  seen[1].h = -6.0;
  seen[2].h = -14.9;
  EXPECT_NEAR(network_.joint_value(std::span(seen).first(2)),
              pair_value(tensors_, seen[0], seen[1]), 1e-4);
  const double all = network_.joint_value(seen);
  EXPECT_NEAR(
      all,
      std::max({pair_value(tensors_, seen[0], seen[1]), pair_value(tensors_, seen[0], seen[2]),
                pair_value(tensors_, seen[1], seen[2])}),
      1e-4);
  std::reverse(seen.begin(), seen.end());
  EXPECT_EQ(network_.joint_value(seen), all);

  formats::Tensors no_pairs;
  for (const auto& [name, tensor] : tensors_.tensors) {
    if (name.find("pair_") == std::string::npos) {
      no_pairs.tensors[name] = tensor;
    }
  }
  const Network alone = Network::from(no_pairs, "weights").value();
  EXPECT_FALSE(alone.knows_pairs());
  std::array<double, 3> v{};
  alone.values(seen, v);
  EXPECT_EQ(alone.joint_value(seen), *std::max_element(v.begin(), v.end()));
}

TEST_F(NetworkTest, QOfTwoObstaclesIsAtLeastThatOfEach) {
  std::array<SeenByNet, 2> seen{drawn_seen(random_), drawn_seen(random_)};
  seen[0].h = -3.0;
  const std::array<Demand, 3> demands{{{-1.0, 0.0}, {0.0, 1.0}, {0.2, -0.3}}};
  const auto q_of = [&](std::span<const SeenByNet> some) {
    std::array<double, 3> q{};
    network_.joint_values_of(some, demands, q);
    return q;
  };
  for (const double h : {-5.0, -14.9}) {
    seen[1].h = h;
    const auto one = q_of(std::span(seen).first(1));
    const auto other = q_of(std::span(seen).last(1));
    const auto both = q_of(seen);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GE(both[i], std::max(one[i], other[i]));
    }
  }
}

TEST_F(NetworkTest, AllocatesNothing) {
  std::vector<SeenByNet> seen(32, drawn_seen(random_));
  std::vector<double> v(32);
  const std::vector<Demand> demands(32);
  const std::size_t before = num_allocations;
  network_.values(seen, v);
  network_.joint_values_of(std::span(seen).first(3), demands, v);
  std::ignore = network_.joint_value(std::span(seen).first(3));
  EXPECT_EQ(num_allocations, before);
}

TEST_F(NetworkTest, IsNamedByItsWeights) {
  EXPECT_EQ(network_.digest(), Network::from(tensors_, "again").value().digest());
  formats::Tensors other = tensors_;
  other.tensors["q2.3.bias"].values[0] += 1e-3F;
  EXPECT_NE(network_.digest(), Network::from(other, "other").value().digest());
}

TEST_F(NetworkTest, RefusesWeightsThatWereAltered) {
  formats::Tensors tensors = tensors_;
  char digest[17];
  std::snprintf(digest, sizeof(digest), "%016llx",
                static_cast<unsigned long long>(network_.digest()));
  tensors.words["digest"] = digest;
  EXPECT_TRUE(Network::from(tensors, "some.safetensors").has_value());
  tensors.tensors["pair_q1.1.bias"].values[5] += 1e-3F;
  const auto altered = Network::from(tensors, "some.safetensors");
  ASSERT_FALSE(altered.has_value());
  EXPECT_NE(altered.error().message.find("some.safetensors: want the weights whose digest"),
            std::string::npos);
}

TEST_F(NetworkTest, RefusesWhatIsNotItsWeights) {
  for (const std::string name :
       {"v.0.weight", "q1.2.bias", "q2.3.weight", "pair_v.3.bias", "pair_q2.0.weight"}) {
    formats::Tensors other = tensors_;
    other.tensors.erase(name);
    const auto network = Network::from(other, "some.safetensors");
    ASSERT_FALSE(network.has_value());
    EXPECT_NE(network.error().message.find("some.safetensors"), std::string::npos);
    EXPECT_NE(network.error().message.find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace saca::learned_danger::network_test

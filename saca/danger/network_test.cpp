#include "saca/danger/network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "saca/danger/random.h"
#include "tests/support/count_allocations.h"

namespace saca::danger::network_test {
namespace {

using manoeuvre::Demand;

config::Tensors drawn_tensors(Random& random) {
  config::Tensors all;
  const auto add = [&](const std::string& name, std::size_t inputs) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t rows = k < 3 ? Network::width : 1;
      const std::size_t columns = k > 0 ? Network::width : inputs;
      const double most = std::sqrt(3.0 / static_cast<double>(columns));
      config::Tensor weight{{rows, columns}, {}};
      config::Tensor bias{{rows}, {}};
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
double added(const config::Tensors& all, const std::string& name, std::vector<double> x) {
  for (int k = 0; k < 4; ++k) {
    const config::Tensor& weight = all.tensors.at(name + std::to_string(k) + ".weight");
    const config::Tensor& bias = all.tensors.at(name + std::to_string(k) + ".bias");
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
  const config::Tensors tensors_ = drawn_tensors(random_);
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
  network_.values_of(seen, demands, q);
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

TEST_F(NetworkTest, AllocatesNothing) {
  std::vector<SeenByNet> seen(32, drawn_seen(random_));
  std::vector<double> v(32);
  const std::vector<Demand> demands(32);
  const std::size_t before = num_allocations;
  network_.values(seen, v);
  network_.values_of(seen[0], demands, v);
  EXPECT_EQ(num_allocations, before);
}

TEST_F(NetworkTest, IsNamedByItsWeights) {
  EXPECT_EQ(network_.digest(), Network::from(tensors_, "again").value().digest());
  config::Tensors other = tensors_;
  other.tensors["q2.3.bias"].values[0] += 1e-3F;
  EXPECT_NE(network_.digest(), Network::from(other, "other").value().digest());
}

TEST_F(NetworkTest, RefusesWhatIsNotItsWeights) {
  for (const std::string name : {"v.0.weight", "q1.2.bias", "q2.3.weight"}) {
    config::Tensors other = tensors_;
    other.tensors.erase(name);
    const auto network = Network::from(other, "some.safetensors");
    ASSERT_FALSE(network.has_value());
    EXPECT_NE(network.error().message.find("some.safetensors"), std::string::npos);
    EXPECT_NE(network.error().message.find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace saca::danger::network_test

#include "saca/danger/network.h"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "saca/core/contract.h"
#include "saca/core/fnv.h"

namespace saca::danger {
namespace {

constexpr std::size_t num_actions = 2;

/// One column for each that is looked at.
using Columns = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                              static_cast<int>(Network::width), static_cast<int>(Network::at_once)>;
using Weights =
    Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// As the training has it (torch's softplus, which is the identity from 20 on).
float softplus(float x) {
  return x > 20.0F ? x : std::log1p(std::exp(x));
}

}  // namespace

Result<Network::Layers> Network::layers_from(const config::Tensors& tensors,
                                             const std::string& prefix, std::size_t inputs,
                                             std::string_view source) {
  Layers layers;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    Layer& layer = layers[k];
    layer.rows = k + 1 < layers.size() ? width : 1;
    layer.columns = k > 0 ? width : inputs;
    const std::string name = prefix + std::to_string(k);
    auto weight = config::take(tensors, name + ".weight", {layer.rows, layer.columns}, source);
    if (!weight.has_value()) {
      return weight.error();
    }
    auto bias = config::take(tensors, name + ".bias", {layer.rows}, source);
    if (!bias.has_value()) {
      return bias.error();
    }
    layer.weight = std::move(weight).value();
    layer.bias = std::move(bias).value();
  }
  return layers;
}

Result<Network> Network::from(const config::Tensors& tensors, std::string_view source) {
  Network network;
  auto v = layers_from(tensors, "v.", num_net_inputs, source);
  auto q1 = layers_from(tensors, "q1.", num_net_inputs + num_actions, source);
  auto q2 = layers_from(tensors, "q2.", num_net_inputs + num_actions, source);
  for (const auto* each : {&v, &q1, &q2}) {
    if (!each->has_value()) {
      return each->error();
    }
  }
  network.v_ = std::move(v).value();
  network.q_ = {std::move(q1).value(), std::move(q2).value()};
  network.words_ = tensors.words;
  return network;
}

std::uint64_t Network::digest() const {
  Fnv hash;
  for (const Layers* layers : {&v_, &q_[0], &q_[1]}) {
    for (const Layer& layer : *layers) {
      for (const std::vector<float>* numbers : {&layer.weight, &layer.bias}) {
        for (const float number : *numbers) {
          hash.add(std::bit_cast<std::uint32_t>(number));
        }
      }
    }
  }
  return hash.value();
}

void Network::run(const Layers& layers, const float* inputs, std::size_t count, float* out) {
  const auto columns = static_cast<Eigen::Index>(count);
  Columns x = Eigen::Map<const Eigen::MatrixXf>(
      inputs, static_cast<Eigen::Index>(layers[0].columns), columns);
  Columns y;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Layer& layer = layers[k];
    const auto rows = static_cast<Eigen::Index>(layer.rows);
    const Weights weight(layer.weight.data(), rows, static_cast<Eigen::Index>(layer.columns));
    y.resize(rows, columns);
    y.noalias() = weight * x;
    y.colwise() += Eigen::Map<const Eigen::VectorXf>(layer.bias.data(), rows);
    if (k + 1 < layers.size()) {
      y = y.cwiseMax(0.0F);
    }
    std::swap(x, y);
  }
  std::copy_n(x.data(), count, out);
}

void Network::values(std::span<const SeenByNet> seen, std::span<double> v) const {
  expects(seen.size() == v.size(), "room for as many values");
  std::array<float, num_net_inputs * at_once> inputs;
  std::array<float, at_once> added;
  for (std::size_t first = 0; first < seen.size(); first += at_once) {
    const std::size_t count = std::min(at_once, seen.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      std::copy(seen[first + i].inputs.begin(), seen[first + i].inputs.end(),
                &inputs[i * num_net_inputs]);
    }
    run(v_, inputs.data(), count, added.data());
    for (std::size_t i = 0; i < count; ++i) {
      v[first + i] = told(seen[first + i].h) + static_cast<double>(softplus(added[i]));
    }
  }
}

void Network::values_of(const SeenByNet& seen, std::span<const manoeuvre::Demand> demands,
                        std::span<double> q) const {
  expects(demands.size() == q.size(), "room for as many values");
  constexpr std::size_t num_inputs = num_net_inputs + num_actions;
  std::array<float, num_inputs * at_once> inputs;
  std::array<std::array<float, at_once>, 2> added;
  for (std::size_t first = 0; first < demands.size(); first += at_once) {
    const std::size_t count = std::min(at_once, demands.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      float* const one = std::copy(seen.inputs.begin(), seen.inputs.end(), &inputs[i * num_inputs]);
      one[0] = static_cast<float>(demands[first + i].along);
      one[1] = static_cast<float>(demands[first + i].across);
    }
    for (std::size_t k = 0; k < q_.size(); ++k) {
      run(q_[k], inputs.data(), count, added[k].data());
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float most = softplus(std::max(added[0][i], added[1][i]));
      q[first + i] = told(seen.h) + static_cast<double>(most);
    }
  }
}

}  // namespace saca::danger

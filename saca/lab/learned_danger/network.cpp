#include "saca/lab/learned_danger/network.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"

namespace saca::learned_danger {
namespace {

constexpr std::size_t num_actions = 2;

/// Of inputs or of units, whichever are more.
constexpr std::size_t most_rows = std::max(Network::width, num_pair_inputs + num_actions);
/// One column for each that is looked at.
using Columns = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                              static_cast<int>(most_rows), static_cast<int>(Network::at_once)>;
using Weights =
    Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// As the training has it (torch's softplus, which is the identity from 20 on).
float softplus(float x) {
  return x > 20.0F ? x : std::log1p(std::exp(x));
}

}  // namespace

Result<Network::Layers> Network::layers_from(const formats::Tensors& tensors,
                                             const std::string& prefix, std::size_t inputs,
                                             std::string_view source) {
  Layers layers;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    auto layer =
        formats::take_layer(tensors, prefix + std::to_string(k), k + 1 < layers.size() ? width : 1,
                            k > 0 ? width : inputs, source);
    if (!layer.has_value()) {
      return layer.error();
    }
    layers[k] = std::move(layer).value();
  }
  return layers;
}

Result<Network::TwoQ> Network::two_q_from(const formats::Tensors& tensors,
                                          const std::string& prefix, std::size_t inputs,
                                          std::string_view source) {
  auto q1 = layers_from(tensors, prefix + "q1.", inputs + num_actions, source);
  auto q2 = layers_from(tensors, prefix + "q2.", inputs + num_actions, source);
  for (const auto* each : {&q1, &q2}) {
    if (!each->has_value()) {
      return each->error();
    }
  }
  return TwoQ{std::move(q1).value(), std::move(q2).value()};
}

Result<Network> Network::from(const formats::Tensors& tensors, std::string_view source) {
  Network network;
  auto v = layers_from(tensors, "v.", num_net_inputs, source);
  if (!v.has_value()) {
    return v.error();
  }
  auto q = two_q_from(tensors, "", num_net_inputs, source);
  if (!q.has_value()) {
    return q.error();
  }
  network.v_ = std::move(v).value();
  network.q_ = std::move(q).value();
  if (tensors.tensors.contains("pair_v.0.weight")) {
    auto pair_v = layers_from(tensors, "pair_v.", num_pair_inputs, source);
    if (!pair_v.has_value()) {
      return pair_v.error();
    }
    network.pair_v_ = std::move(pair_v).value();
  }
  if (tensors.tensors.contains("pair_q1.0.weight")) {
    auto pair_q = two_q_from(tensors, "pair_", num_pair_inputs, source);
    if (!pair_q.has_value()) {
      return pair_q.error();
    }
    network.pair_q_ = std::move(pair_q).value();
  }
  network.words_ = tensors.words;
  const auto digest = tensors.words.find("digest");
  const std::string own = fmt::format("{:016x}", network.digest());
  if (digest != tensors.words.end() && digest->second != own) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want the weights whose digest it names, {}, got {}: they were "
                             "altered",
                             source, digest->second, own)};
  }
  return network;
}

std::uint64_t Network::digest() const {
  Fnv hash;
  const auto add = [&](const Layers& layers) {
    for (const formats::Layer& layer : layers) {
      layer.add_to(hash);
    }
  };
  add(v_);
  std::for_each(q_.begin(), q_.end(), add);
  if (pair_v_) {
    add(*pair_v_);
  }
  if (pair_q_) {
    std::for_each(pair_q_->begin(), pair_q_->end(), add);
  }
  return hash.value();
}

void Network::run(const Layers& layers, const float* inputs, std::size_t count, float* out) {
  const auto columns = static_cast<Eigen::Index>(count);
  Columns x = Eigen::Map<const Eigen::MatrixXf>(
      inputs, static_cast<Eigen::Index>(layers[0].columns), columns);
  Columns y;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const formats::Layer& layer = layers[k];
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
  std::transform(x.data(), x.data() + count, out, softplus);
}

void Network::run_q(const TwoQ& q, std::span<const float> inputs,
                    std::span<const manoeuvre::Demand> demands, float* out) {
  std::array<float, (num_pair_inputs + num_actions) * at_once> columns;
  std::array<float, at_once> other;
  for (std::size_t first = 0; first < demands.size(); first += at_once) {
    const std::size_t count = std::min(at_once, demands.size() - first);
    float* next = columns.data();
    for (const manoeuvre::Demand& demand : demands.subspan(first, count)) {
      next = std::copy(inputs.begin(), inputs.end(), next);
      *next++ = static_cast<float>(demand.along);
      *next++ = static_cast<float>(demand.across);
    }
    run(q[0], columns.data(), count, out + first);
    run(q[1], columns.data(), count, other.data());
    for (std::size_t i = 0; i < count; ++i) {
      out[first + i] = std::max(out[first + i], other[i]);
    }
  }
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
      v[first + i] = told(seen[first + i].h) + static_cast<double>(added[i]);
    }
  }
}

/// Each two of which what they add counts.
template <class Use>
void Network::for_pairs(std::span<const SeenByNet> seen,
                        const std::array<double, most_obstacles>& v, const Use& use) const {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = i + 1; k < seen.size(); ++k) {
      const std::size_t one = v[i] >= v[k] ? i : k;  // the more dangerous one
      const std::size_t other = v[i] >= v[k] ? k : i;
      Pair pair{.one = one, .other = other, .value = v[one], .share = pair_share(v[other])};
      if (pair.share == 0.0) {
        continue;
      }
      float* next = pair.inputs.data();
      for (const std::size_t which : {one, other}) {
        next = std::copy(seen[which].inputs.begin(), seen[which].inputs.end(), next);
      }
      *next++ = pair_value_scale * static_cast<float>(v[one]);
      *next++ = pair_value_scale * static_cast<float>(v[other]);
      use(pair);
    }
  }
}

double Network::joint_value(std::span<const SeenByNet> seen) const {
  expects(!seen.empty() && seen.size() <= most_obstacles, "one to three obstacles");
  std::array<double, most_obstacles> v{};
  values(seen, std::span(v).first(seen.size()));
  double highest =
      *std::max_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(seen.size()));
  if (!pair_v_) {
    return highest;
  }
  for_pairs(seen, v, [&](const Pair& pair) {
    float added = 0.0F;
    run(*pair_v_, pair.inputs.data(), 1, &added);
    highest = std::max(highest, pair.value + pair.share * static_cast<double>(added));
  });
  return highest;
}

void Network::joint_values_of(std::span<const SeenByNet> seen,
                              std::span<const manoeuvre::Demand> demands,
                              std::span<double> q) const {
  expects(!seen.empty() && seen.size() <= most_obstacles, "one to three obstacles");
  expects(demands.size() == q.size() && demands.size() <= most_demands, "room for as many values");
  std::array<float, most_demands> added;
  std::array<std::array<double, most_demands>, most_obstacles> single;
  std::fill(q.begin(), q.end(), -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    run_q(q_, seen[k].inputs, demands, added.data());
    for (std::size_t i = 0; i < demands.size(); ++i) {
      single[k][i] = told(seen[k].h) + static_cast<double>(added[i]);
      q[i] = std::max(q[i], single[k][i]);
    }
  }
  if (!pair_q_ || seen.size() < 2) {
    return;
  }
  std::array<double, most_obstacles> v{};
  values(seen, std::span(v).first(seen.size()));
  for_pairs(seen, v, [&](const Pair& pair) {
    run_q(*pair_q_, pair.inputs, demands, added.data());
    for (std::size_t i = 0; i < demands.size(); ++i) {
      const double higher = std::max(single[pair.one][i], single[pair.other][i]);
      q[i] = std::max(q[i], higher + pair.share * static_cast<double>(added[i]));
    }
  });
}

}  // namespace saca::learned_danger

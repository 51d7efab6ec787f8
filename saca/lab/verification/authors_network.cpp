#include "saca/lab/verification/authors_network.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "saca/base/core/units.h"

namespace saca::verification {
namespace {

constexpr std::size_t num_inputs = 4;
constexpr std::array<std::string_view, 3> layer_names{"MLP_0_Dense_0", "MLP_0_Dense_1",
                                                      "OutputVDense"};

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::Matrix<float, 1, Eigen::Dynamic>;

std::array<double, num_inputs> network_inputs(const AuthorsState& state) {
  return {(state.x + 50.0) / 50.0, std::abs(state.y) / 8.0, std::abs(to_degrees(state.yaw)) / 40.0,
          state.speed / 18.0};
}

std::string described_shape(const std::vector<std::size_t>& shape) {
  std::string all;
  for (const std::size_t extent : shape) {
    all += (all.empty() ? "" : " x ") + std::to_string(extent);
  }
  return all.empty() ? "a single number" : all;
}

Eigen::Index index_of(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

}  // namespace

bool in_authors_range(const AuthorsState& state) {
  const auto inputs = network_inputs(state);
  return std::all_of(inputs.begin(), inputs.end(),
                     [](double input) { return input >= 0.0 && input <= 1.0; });
}

Result<AuthorsNetwork> AuthorsNetwork::from(const std::map<std::string, NpyArray>& arrays,
                                            const std::string& source) {
  const auto malformed = [&](const std::string& what) {
    return Error{Error::Code::malformed, source + ": " + what};
  };
  AuthorsNetwork network;
  std::size_t inputs = num_inputs;
  for (const std::string_view name : layer_names) {
    const std::string kernel_name = std::string(name) + "_kernel";
    const std::string bias_name = std::string(name) + "_bias";
    const auto kernel = arrays.find(kernel_name);
    const auto bias = arrays.find(bias_name);
    if (kernel == arrays.end() || bias == arrays.end()) {
      return malformed("want the array " + (kernel == arrays.end() ? kernel_name : bias_name));
    }
    const auto& shape = kernel->second.shape;
    const bool is_last = name == layer_names.back();
    if (shape.size() != 2 || shape[0] != inputs || shape[1] == 0 || (is_last && shape[1] != 1)) {
      return malformed(fmt::format("{}: want {} x {}, got {}", kernel_name, inputs,
                                   is_last ? "1" : "any number", described_shape(shape)));
    }
    if (bias->second.shape != std::vector<std::size_t>{shape[1]}) {
      return malformed(fmt::format("{}: want {}, got {}", bias_name, shape[1],
                                   described_shape(bias->second.shape)));
    }
    const auto singles = [](const std::vector<double>& values) {
      std::vector<float> all(values.size());
      std::transform(values.begin(), values.end(), all.begin(),
                     [](double value) { return static_cast<float>(value); });
      return all;
    };
    network.layers_.push_back(
        {inputs, shape[1], singles(kernel->second.values), singles(bias->second.values)});
    inputs = shape[1];
  }
  if (arrays.size() != 2 * layer_names.size()) {
    return malformed(fmt::format("want {} arrays, got {}", 2 * layer_names.size(), arrays.size()));
  }
  return network;
}

std::vector<double> AuthorsNetwork::values(std::span<const AuthorsState> states) const {
  constexpr std::size_t at_once = 256;
  std::vector<double> all;
  all.reserve(states.size());
  for (std::size_t from = 0; from < states.size(); from += at_once) {
    const std::size_t count = std::min(at_once, states.size() - from);
    Matrix numbers(index_of(count), index_of(num_inputs));
    for (std::size_t i = 0; i < count; ++i) {
      const auto inputs = network_inputs(states[from + i]);
      for (std::size_t k = 0; k < num_inputs; ++k) {
        numbers(index_of(i), index_of(k)) = static_cast<float>(inputs[k]);
      }
    }
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const Layer& layer = layers_[i];
      const Eigen::Map<const Matrix> kernel(layer.kernel.data(), index_of(layer.inputs),
                                            index_of(layer.outputs));
      const Eigen::Map<const Vector> bias(layer.bias.data(), index_of(layer.outputs));
      Matrix sums = (numbers * kernel).rowwise() + bias;
      const bool is_last = i + 1 == layers_.size();
      numbers = is_last ? std::move(sums) : Matrix(sums.cwiseMax(0.0F));
    }
    for (std::size_t i = 0; i < count; ++i) {
      all.push_back(static_cast<double>(numbers(index_of(i), 0)));
    }
  }
  return all;
}

Result<AuthorsNetwork> read_authors_network(const std::filesystem::path& path) {
  const auto arrays = read_npz(path);
  if (!arrays.has_value()) {
    return arrays.error();
  }
  return AuthorsNetwork::from(arrays.value(), path.string());
}

}  // namespace saca::verification

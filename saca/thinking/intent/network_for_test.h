#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/formats/tensors.h"
#include "saca/thinking/intent/network.h"

namespace saca::intent {

/// Random weights under `prefix`.
inline void add_random_network(formats::Tensors& tensors, const std::string& prefix,
                               std::uint32_t seed) {
  constexpr std::size_t w = Network::width;
  std::mt19937 random(seed);
  const auto add = [&](const std::string& name, std::size_t rows, std::size_t columns) {
    std::normal_distribution<float> normal(0.0F, 1.0F / std::sqrt(static_cast<float>(columns)));
    std::vector<float> weight(rows * columns);
    std::vector<float> bias(rows);
    for (float& each : weight) {
      each = normal(random);
    }
    for (float& each : bias) {
      each = normal(random);
    }
    tensors.tensors[prefix + name + ".weight"] = {{rows, columns}, std::move(weight)};
    tensors.tensors[prefix + name + ".bias"] = {{rows}, std::move(bias)};
  };
  add("input", w, num_features);
  add("lstm", 4 * w, 2 * w);
  add("output", Network::num_emissions, 2 * w);
}

}  // namespace saca::intent

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/network.h"

namespace saca::learned_danger {

/// V and both Q beside one obstacle, in which each layer hands on what its first unit has, and the
/// first layer reads nothing yet: who tests sets some of `v.0.weight`, `q1.0.weight`, ..., whose
/// first numbers are the first unit's, and of the biases.
inline formats::Tensors networks_that_hand_on() {
  formats::Tensors all;
  for (const auto& [name, inputs] : {std::pair<std::string, std::size_t>{"v.", num_net_inputs},
                                     {"q1.", num_net_inputs + 2},
                                     {"q2.", num_net_inputs + 2}}) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t rows = k < 3 ? Network::width : 1;
      const std::size_t columns = k > 0 ? Network::width : inputs;
      formats::Tensor weight{{rows, columns}, std::vector<float>(rows * columns)};
      weight.values[0] = k > 0 ? 1.0F : 0.0F;
      all.tensors[name + std::to_string(k) + ".weight"] = std::move(weight);
      all.tensors[name + std::to_string(k) + ".bias"] = {{rows}, std::vector<float>(rows)};
    }
  }
  return all;
}

}  // namespace saca::learned_danger

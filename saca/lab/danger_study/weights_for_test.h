#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/network.h"

namespace saca::danger_study {

/// Networks whose layers are 0: each value is h + log 2, so that they see what comes within 0.7 m
/// at most.
inline formats::Tensors blind_networks(const std::map<std::string, std::string>& words) {
  using learned_danger::num_net_inputs;
  constexpr std::size_t width = learned_danger::Network::width;
  formats::Tensors all{.words = words, .tensors = {}};
  for (const auto& [name, inputs] : {std::pair<std::string, std::size_t>{"v.", num_net_inputs},
                                     {"q1.", num_net_inputs + 2},
                                     {"q2.", num_net_inputs + 2}}) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t rows = k < 3 ? width : 1;
      const std::size_t columns = k > 0 ? width : inputs;
      const std::string layer = name + std::to_string(k);
      all.tensors[layer + ".weight"] = {{rows, columns}, std::vector<float>(rows * columns)};
      all.tensors[layer + ".bias"] = {{rows}, std::vector<float>(rows)};
    }
  }
  return all;
}

inline learned_danger::Network blind_network() {
  return learned_danger::Network::from(blind_networks({}), "made here").value();
}

}  // namespace saca::danger_study

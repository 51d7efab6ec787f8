#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/saca/inputs.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/check.h"
#include "saca/lab/learned_danger/network.h"

namespace saca::app {

/// What a file of weights says, and the car that it is of.
struct DangerWeights {
  formats::Tensors tensors;
  learned_danger::Network network;
  std::string car_name;
  Inputs inputs;
  world::Footprint body;  ///< of the car, about its centre of mass
};

/// @return  an error naming file, tensor or word, wanted and got
[[nodiscard]] Result<DangerWeights> read_danger_weights(const std::string& path);

/// So many situations from one on, in parallel; each has the seed of its number.
/// @param name  what they are for: others are others
template <class Case>
[[nodiscard]] std::vector<Case> checked_situations(
    const std::string& name, int first, int count, int threads, std::uint64_t seed,
    const std::function<Case(std::uint64_t seed)>& check) {
  std::vector<Case> all(static_cast<std::size_t>(count));
  in_parallel(all.size(), threads, [&](std::size_t i) {
    Fnv hash;
    hash.add(fmt::format("{} {} {}", name, seed, static_cast<std::size_t>(first) + i));
    all[i] = check(hash.value());
  });
  return all;
}

/// Without a look at its car: weights of a point mass have none.
[[nodiscard]] Result<learned_danger::Network> read_danger_network(const std::string& path);

/// `saca danger check`.
void add_danger_check(CLI::App& danger, int& exit_code);
/// `saca danger coverage`.
void add_danger_coverage(CLI::App& danger, int& exit_code);
/// `saca danger margins`.
void add_danger_margins(CLI::App& danger, int& exit_code);
/// `saca danger show`.
void add_danger_show(CLI::App& danger, int& exit_code);

}  // namespace saca::app

#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"

namespace saca::danger_study {

/// Situations that are drawn by their numbers, so that neither threads nor how many are worked on
/// at a time change any.
struct NumberedSituations {
  std::string name;  ///< what they are for: others are others
  std::uint64_t seed = 1;
  int threads = 1;
};

/// What comes of so many situations from number `first` on; each has the seed of its number.
template <class Case>
[[nodiscard]] std::vector<Case> worked_out(const NumberedSituations& all, int first, int count,
                                           const std::function<Case(std::uint64_t seed)>& check) {
  std::vector<Case> some(static_cast<std::size_t>(count));
  in_parallel(some.size(), all.threads, [&](std::size_t i) {
    Fnv hash;
    hash.add(fmt::format("{} {} {}", all.name, all.seed, static_cast<std::size_t>(first) + i));
    some[i] = check(hash.value());
  });
  return some;
}

}  // namespace saca::danger_study

#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "saca/base/core/clock.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::benchmarks {

/// Every call somewhere else: what the memory takes is in it.
constexpr std::size_t num_look_ups = std::size_t{1} << 16;

/// reach.lookup_us: of a value at a state drawn evenly from the grid.
[[nodiscard]] nlohmann::json look_up_times(const danger::Solution& solved, const Clock& clock,
                                           std::size_t num_samples = 20'000);

}  // namespace saca::benchmarks

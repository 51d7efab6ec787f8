#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/percentile.h"

namespace saca::benchmarks {

/// Percentiles of one call [us], NAME.p50 and .p99, over samples that are each the mean of a few:
/// the clock itself takes a while.
/// @param call  of a number that rises from 0 on; gives a number
/// @return  .p50 is no number where the calls gave none, so that it is seen
template <class Call>
[[nodiscard]] nlohmann::json call_times(const std::string& name, const Call& call,
                                        const Clock& clock, std::size_t num_samples) {
  constexpr int calls_per_sample = 16;
  std::vector<double> times;
  times.reserve(num_samples);
  double sum = 0.0;  // so that no call is left out
  for (std::size_t i = 0; times.size() < num_samples;) {
    const Clock::Time start = clock.now();
    for (int k = 0; k < calls_per_sample; ++k) {
      sum += call(i++);
    }
    times.push_back(1e6 * to_seconds(clock.now() - start) / calls_per_sample);
  }
  nlohmann::json figures;
  figures[name + ".p50"] = std::isfinite(sum) ? percentile(times, 0.5) : sum;
  figures[name + ".p99"] = percentile(times, 0.99);
  return figures;
}

}  // namespace saca::benchmarks

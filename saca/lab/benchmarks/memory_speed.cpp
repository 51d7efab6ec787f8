#include "saca/lab/benchmarks/memory_speed.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "saca/base/core/parallel.h"

namespace saca::benchmarks {
namespace {

/// What a step must move of each point: values and h in and values out, and in its second stage
/// what it began with; neighbours are taken to be in a cache.
constexpr double numbers_per_stage = (3.0 + 4.0) / 2.0;

}  // namespace

double memory_speed(int threads, const Clock& clock, std::size_t size) {
  constexpr std::size_t parts = 64;
  std::vector<float> a(size, 0.0F), b(size, 1.0F), c(size, 2.0F);
  double best = 0.0;
  for (int run = 0; run < 6; ++run) {
    const Clock::Time start = clock.now();
    in_parallel(parts, threads, [&](std::size_t part) {
      float* const to = a.data();
      const float* const left = b.data();
      const float* const right = c.data();
      for (std::size_t i = size / parts * part; i < size / parts * (part + 1); ++i) {
        to[i] = left[i] + 3.0F * right[i];
      }
    });
    const double seconds = to_seconds(clock.now() - start);
    best = std::max(best, 3.0 * sizeof(float) * static_cast<double>(size) / seconds);
    std::swap(a, b);  // what was written is read: nothing is left out
  }
  return best;
}

nlohmann::json roofline(double speed, double ns_per_point_stage) {
  const double seconds = 1e-9 * ns_per_point_stage;
  return {{"reach.memory_gb_per_s", 1e-9 * speed},
          {"reach.bytes_per_point_stage", numbers_per_stage * sizeof(float)},
          {"reach.roofline_share", numbers_per_stage * sizeof(float) / speed / seconds}};
}

}  // namespace saca::benchmarks

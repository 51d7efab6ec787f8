#include "saca/base/world/footprint.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <random>

namespace saca::world {
namespace {

// The ego against 64 bodies between touching and 40 m away.
void separation_batch(benchmark::State& state, Footprint other) {
  const Footprint ego{.length = 4.7, .width = 1.9, .centre_x = -0.1};
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> position(-30.0, 30.0);
  std::uniform_real_distribution<double> yaw(-3.1, 3.1);
  std::array<Pose, 64> batch{};
  for (Pose& X_WA : batch) {
    X_WA = {{position(rng), position(rng)}, yaw(rng)};
  }
  for (auto _ : state) {
    for (const Pose& X_WA : batch) {
      benchmark::DoNotOptimize(separation(ego, {{0.3, 0.2}, 0.1}, other, X_WA));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch.size()));
}
BENCHMARK_CAPTURE(separation_batch, box_to_box, Footprint{.length = 4.5, .width = 1.8});
BENCHMARK_CAPTURE(separation_batch, box_to_ellipse,
                  Footprint{.shape = Shape::ellipse, .length = 0.3, .width = 0.5});
BENCHMARK_CAPTURE(separation_batch, box_to_long_ellipse,
                  Footprint{.shape = Shape::ellipse, .length = 12.0, .width = 2.5});

}  // namespace
}  // namespace saca::world

#include "saca/memory/feature_index.h"

#include <benchmark/benchmark.h>

#include "saca/memory/example_scenes.h"

namespace saca::memory::feature_index_bench {
namespace {

void nearest_of(benchmark::State& state) {
  std::mt19937 rng(1);
  FeatureIndex index;
  for (int i = 0; i < state.range(0); ++i) {
    index.add(i + 1, random_scene(rng, static_cast<int>(rng() % 9)));
  }
  std::vector<Features> wanted;
  for (int i = 0; i < 64; ++i) {
    wanted.push_back(features(random_scene(rng, i % 9)));
  }
  std::size_t turn = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.nearest(wanted[turn++ % wanted.size()]));
  }
}
BENCHMARK(nearest_of)->Arg(1'000)->Arg(30'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::memory::feature_index_bench

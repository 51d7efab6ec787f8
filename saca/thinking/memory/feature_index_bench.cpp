#include "saca/onboard/match/feature_index.h"

#include <benchmark/benchmark.h>

#include <array>
#include <map>

#include "saca/onboard/match/example_scenes.h"

namespace saca::match::feature_index_bench {
namespace {

/// Made once for each size, although a benchmark is run several times.
const FeatureIndex& index_of(std::int64_t size) {
  static std::map<std::int64_t, FeatureIndex> made;
  const auto [place, is_new] = made.try_emplace(size);
  std::mt19937 rng(1);
  for (CaseId id = 1; is_new && id <= size; ++id) {
    place->second.add(id, random_scene(rng, static_cast<int>(rng() % 9)));
  }
  return place->second;
}

void nearest_of(benchmark::State& state) {
  const FeatureIndex& index = index_of(state.range(0));
  std::mt19937 rng(2);
  std::vector<Features> wanted(64);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = features(random_scene(rng, static_cast<int>(i % 9)));
  }
  std::size_t turn = 0;
  std::array<FeatureIndex::Hit, 1> hit;
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.nearest(wanted[turn++ % wanted.size()], hit));
  }
}
BENCHMARK(nearest_of)->Arg(1'000)->Arg(30'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::match::feature_index_bench

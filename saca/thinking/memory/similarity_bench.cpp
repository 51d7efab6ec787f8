#include "saca/onboard/match/similarity.h"

#include <benchmark/benchmark.h>

#include "saca/onboard/match/example_scenes.h"

namespace saca::match::similarity_bench {
namespace {

// The reflex plane matches the scene of the trigger with a cached forecast of itself.
void similarity_to_own_forecast(benchmark::State& state) {
  std::mt19937 rng(1);
  const world::Scene scene = random_scene(rng, static_cast<int>(state.range(0)));
  world::Scene forecast = scene;
  for (world::Actor& actor : forecast.actors) {
    actor.X_WA.p = actor.X_WA.p + Vec2{0.2, -0.2};
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(similarity(scene, forecast));
  }
}
BENCHMARK(similarity_to_own_forecast)->Arg(1)->Arg(8)->Arg(32);

// Strangers need the search for the best assignment.
void similarity_of_strangers(benchmark::State& state) {
  std::mt19937 rng(2);
  const world::Scene a = random_scene(rng, static_cast<int>(state.range(0)));
  const world::Scene b = random_scene(rng, static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(similarity(a, b));
  }
}
BENCHMARK(similarity_of_strangers)->Arg(1)->Arg(8)->Arg(32);

void features_of_a_scene(benchmark::State& state) {
  std::mt19937 rng(3);
  const world::Scene scene = random_scene(rng, static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(features(scene));
  }
}
BENCHMARK(features_of_a_scene)->Arg(1)->Arg(8)->Arg(32);

}  // namespace
}  // namespace saca::match::similarity_bench

#include "saca/outcome/outcome.h"

#include <benchmark/benchmark.h>

#include "saca/outcome/encounters_for_test.h"

namespace saca::outcome {
namespace {

// Three seconds of driving past eight actors, none of them met: every sample must be looked at.
void judge_past_8_actors(benchmark::State& state) {
  const HarmModel harm = shipped_harm();
  Encounter encounter;
  encounter.motion = steady_ego({}, {15.0, 0.0}, 0.05, 3.0);
  encounter.scene.road.left_edge = 9.0;
  encounter.scene.road.right_edge = -5.25;
  for (int i = 0; i < 4; ++i) {
    encounter.add_car({{10.0 + 12.0 * i, 7.5}, 3.1}, {-12.0, 0.0});
    encounter.add_car({{-6.0 + 12.0 * i, -3.5}, 0.0}, {14.0 + i, 0.0});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(encounter.judged(harm));
  }
  state.SetLabel(encounter.judged(harm).contact ? "contact" : "no contact");
}
BENCHMARK(judge_past_8_actors)->Unit(benchmark::kMicrosecond);

// The same with a ninth that is hit.
void judge_contact_among_8_actors(benchmark::State& state) {
  const HarmModel harm = shipped_harm();
  Encounter encounter;
  encounter.motion = steady_ego({}, {15.0, 0.0}, 0.0, 3.0);
  encounter.add_car({{35.0, 0.3}, 0.0}, {2.0, 0.0});
  for (int i = 0; i < 7; ++i) {
    encounter.add_car({{-6.0 + 8.0 * i, -3.5}, 0.0}, {14.0 + i, 0.0});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(encounter.judged(harm));
  }
  state.SetLabel(encounter.judged(harm).contact ? "contact" : "no contact");
}
BENCHMARK(judge_contact_among_8_actors)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::outcome

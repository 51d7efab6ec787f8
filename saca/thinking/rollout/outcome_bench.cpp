#include "saca/onboard/collision/outcome.h"

#include <benchmark/benchmark.h>

#include <string>

#include "saca/thinking/rollout/encounters_for_test.h"
#include "saca/thinking/rollout/slide.h"

namespace saca::rollout {
namespace {

// Three seconds of driving past eight actors, none of them met: every sample must be looked at.
void judge_past_8_actors(benchmark::State& state) {
  const collision::HarmModel harm = shipped_harm();
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
  const collision::HarmModel harm = shipped_harm();
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

// An impact into the side of a car ahead, a slide, and whatever is met on the way to rest.
void judge_contact_and_aftermath(benchmark::State& state) {
  const collision::HarmModel harm = shipped_harm();
  Encounter encounter;
  encounter.motion = steady_ego({}, {15.0, 0.0}, 0.0, 3.0);
  encounter.scene.road.left_edge = 5.25;
  encounter.scene.road.left_beyond = world::Beyond::barrier;
  encounter.add_car({{25.0, 1.2}, 1.4}, {1.0, 6.0});
  for (int i = 0; i < 7; ++i) {
    encounter.add_car({{-6.0 + 8.0 * i, -3.5}, 0.0}, {14.0 + i, 0.0});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(encounter.judged(harm));
  }
  state.SetLabel(std::to_string(1 + encounter.judged(harm).later.size()) + " contacts");
}
BENCHMARK(judge_contact_and_aftermath)->Unit(benchmark::kMicrosecond);

// 2 s of sliding with spin.
void slide_to_rest(benchmark::State& state) {
  collision::ImpactBody body = collision::free_body(1700.0, {.length = 4.7, .width = 1.9});
  body.v_W = {14.0, 3.0};
  body.yaw_rate = 2.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(slide({.length = 4.7, .width = 1.9}, body, {}, 0.0, 0.8));
  }
}
BENCHMARK(slide_to_rest)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::rollout

#include <benchmark/benchmark.h>

#include "saca/onboard/reflex/reflex_plane.h"

namespace saca::reflex {
namespace {

/// A trigger among `count` others on three lanes, six plans in the cache; without a check at the
/// trigger (`saca bench decide` has it).
void reflex_step(benchmark::State& state) {
  world::Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9};
  scene.ego_mass = 1'700.0;
  for (int i = 0; i < state.range(0); ++i) {
    world::Actor actor{.id = static_cast<std::uint8_t>(i + 1),
                       .footprint = {.length = 4.5, .width = 1.8},
                       .mass = 1'500.0};
    const int row = i / 3;
    actor.X_WA.p = {16.0 + 9.0 * row, 3.5 * ((i + 1) % 3 - 1)};  // the first right ahead
    actor.v_W = {8.0 + i % 5, 0.0};
    scene.actors.push_back(actor);
  }
  PlanCache cache;
  for (int i = 0; i < 6; ++i) {
    cache.push_back({.at_trigger = match::features(scene), .plan = {}, .preview = i});
  }
  for (auto _ : state) {
    ReflexPlane plane({});
    plane.receive(cache);
    benchmark::DoNotOptimize(plane.step(scene));
  }
}
BENCHMARK(reflex_step)->Arg(1)->Arg(8)->Arg(32);

}  // namespace
}  // namespace saca::reflex

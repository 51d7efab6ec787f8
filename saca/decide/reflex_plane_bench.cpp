#include <benchmark/benchmark.h>

#include "saca/decide/reflex_plane.h"

namespace saca::decide {
namespace {

/// A road with `count` others on three lanes, three plans in the cache.
void reflex_step(benchmark::State& state) {
  world::Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  scene.ego_footprint = {.length = 4.7, .width = 1.9};
  scene.ego_mass = 1'700.0;
  for (int i = 0; i < state.range(0); ++i) {
    world::Actor actor{.id = static_cast<std::uint8_t>(i + 1),
                       .footprint = {.length = 4.5, .width = 1.8},
                       .mass = 1'500.0};
    actor.X_WA.p = {45.0 + 9.0 * i, 3.5 * (i % 3 - 1)};
    actor.v_W = {12.0 + i % 5, 0.1 * (i % 3 - 1)};
    scene.actors.push_back(actor);
  }
  PlanCache cache;
  for (int i = 0; i < 3; ++i) {
    cache.push_back({.scene_at_trigger = scene, .plan = {}, .preview = i});
  }
  for (auto _ : state) {
    ReflexPlane plane({});
    plane.receive(cache);
    benchmark::DoNotOptimize(plane.step(scene));
  }
}
BENCHMARK(reflex_step)->Arg(1)->Arg(8)->Arg(32);

}  // namespace
}  // namespace saca::decide

#include "saca/lab/sim/perception.h"

#include <benchmark/benchmark.h>

namespace saca::sim {
namespace {

// Everything that can go wrong does, among cars in four lanes that hide one another.
void look(benchmark::State& state) {
  world::Scene truth{.ego_footprint = {world::Shape::box, 4.6, 1.8}, .ego_mass = 1'500.0};
  for (int i = 0; i < state.range(0); ++i) {
    truth.actors.push_back({.id = static_cast<std::uint8_t>(i + 1),
                            .footprint = {world::Shape::box, 4.5, 1.8},
                            .mass = 1'500.0,
                            .X_WA = {{12.0 * (i / 4 + 1), 3.5 * (i % 4) - 5.25}, 0.0},
                            .v_W = {10.0, 0.0}});
  }
  Perception perception({.position_sd = 0.3,
                         .velocity_sd = 0.4,
                         .heading_sd = 0.02,
                         .correlation_time = 0.2,
                         .latency = 0.1,
                         .dropout = 0.05,
                         .range = 200.0,
                         .occlusion = true,
                         .confirmation = 0.1,
                         .memory = 0.5},
                        1);
  int num_looks = 0;
  for (auto _ : state) {
    truth.time = ++num_looks * Perception::step;
    benchmark::DoNotOptimize(perception.look(truth));
  }
}
BENCHMARK(look)->Arg(8)->Arg(32)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::sim

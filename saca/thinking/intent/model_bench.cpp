#include "saca/thinking/intent/model.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "saca/thinking/intent/network_for_test.h"

namespace saca::intent {
namespace {

/// One step of the streams of 64 vehicles, as many networks as the argument.
void sixty_four_vehicles(benchmark::State& state) {
  const auto num_networks = static_cast<std::size_t>(state.range(0));
  Model model;
  for (std::size_t i = 0; i < num_networks; ++i) {
    formats::Tensors tensors;
    add_random_network(tensors, "", static_cast<std::uint32_t>(i));
    model.networks.push_back(Network::from(tensors, "", "random").value());
  }
  std::vector<Stream> streams(64);
  double time = 0.0;
  for (auto _ : state) {
    time += look_step;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      const double wave = std::sin(time + static_cast<double>(i));
      benchmark::DoNotOptimize(streams[i].step(model, {.speed = 20.0 + wave,
                                                       .acceleration = wave,
                                                       .offset = 0.3 * wave,
                                                       .lateral_speed = 0.3 * wave,
                                                       .heading = 0.01 * wave,
                                                       .lane_width = 3.5,
                                                       .gap = 30.0,
                                                       .gap_speed = -wave}));
    }
  }
}
BENCHMARK(sixty_four_vehicles)->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::intent

#include "saca/thinking/danger/value_table.h"

#include <benchmark/benchmark.h>

#include <numbers>
#include <random>
#include <vector>

namespace saca::danger {
namespace {

constexpr double pi = std::numbers::pi;

// As large as the avoidance problem's: 1.7 million cells.
const ValueTable& large_table() {
  static const ValueTable table = [] {
    const Grid grid{
        {{.name = "x", .first = -70.0, .last = 30.0, .points = 60, .stretch = 15.0},
         {.name = "y",
          .first = 0.0,
          .last = 30.0,
          .points = 22,
          .edge = Edge::mirrored,
          .stretch = 10.0,
          .turned = 2},
         {.name = "course", .first = -pi, .last = pi, .points = 60, .edge = Edge::periodic},
         {.name = "speed", .first = 0.0, .last = 30.0, .points = 22}}};
    std::vector<float> values(num_cells(grid));
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<float>(i % 97) - 40.0F;
    }
    return ValueTable(grid, values, std::vector<float>(values.size(), 0.1F));
  }();
  return table;
}

std::vector<State> anywhere() {
  std::mt19937 chance(1);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<State> states(1 << 16);
  for (State& state : states) {
    state = {100.0 * any(chance) - 70.0, 60.0 * any(chance) - 30.0, 2.0 * pi * any(chance) - pi,
             30.0 * any(chance)};
  }
  return states;
}

// Every look-up somewhere else: the memory's part is in it.
void look_up(benchmark::State& bench) {
  const ValueTable& table = large_table();
  const std::vector<State> states = anywhere();
  std::size_t i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(table.at(states[i++ % states.size()]));
  }
}
BENCHMARK(look_up);

void look_up_gradient(benchmark::State& bench) {
  const ValueTable& table = large_table();
  const std::vector<State> states = anywhere();
  std::size_t i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(table.gradient(states[i++ % states.size()]));
  }
}
BENCHMARK(look_up_gradient);

}  // namespace
}  // namespace saca::danger

#include "saca/lab/benchmarks/look_up_times.h"

#include <random>
#include <vector>

#include "saca/lab/benchmarks/call_times.h"
#include "saca/thinking/danger/grid.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::benchmarks {

nlohmann::json look_up_times(const danger::Solution& solved, const Clock& clock,
                             std::size_t num_samples) {
  const danger::ValueTable table(solved.grid, snapshot(solved, 0), solved.error);
  std::mt19937 rng(1);
  std::vector<danger::State> states(num_look_ups);
  for (danger::State& state : states) {
    for (std::size_t d = 0; d < solved.grid.axes.size(); ++d) {
      const danger::Axis& axis = solved.grid.axes[d];
      const double first = axis.edge == danger::Edge::mirrored ? -axis.last : axis.first;
      state[d] = std::uniform_real_distribution<double>(first, axis.last)(rng);
    }
  }
  return call_times(
      "reach.lookup_us", [&](std::size_t i) { return table.at(states[i % num_look_ups]).value; },
      clock, num_samples);
}

}  // namespace saca::benchmarks

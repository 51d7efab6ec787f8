#include "apps/saca/reach_bench.h"

#include <fmt/core.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "saca/core/parallel.h"
#include "saca/reach/own_systems.h"
#include "saca/reach/solver.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct AirGrid {
  int x, y, heading;
};

template <class Real>
void bench_air3d(const AirGrid& size, int threads, Clock& clock, json& figures) {
  constexpr double horizon = 2.8;
  constexpr int stages = 3;
  const reach::Grid grid = reach::air3d_grid(size.x, size.y, size.heading);
  const reach::Air3d game;
  const auto h = reach::sampled<Real>(
      grid, [&](auto state) { return intrusion(game, state); }, threads);
  reach::Solver<Real> solver(grid, reach::own_flow<Real>(grid, game), h,
                             {.tube = reach::Tube::tube, .threads = threads});
  int steps = 0;
  const Clock::Time start = clock.now();
  while (solver.time() < horizon) {
    const auto taken = solver.step(horizon);
    if (!taken.has_value()) {
      throw std::runtime_error(taken.error().message);
    }
    ++steps;
  }
  const double seconds = to_seconds(clock.now() - start);
  const std::string about = fmt::format(".{}x{}x{}.{}", size.x, size.y, size.heading,
                                        sizeof(Real) == 4 ? "float" : "double");
  const std::string by = fmt::format(".threads{}", threads);
  const double work = static_cast<double>(h.size()) * steps * stages;
  figures["reach.air3d_s" + about + by] = seconds;
  figures["reach.air3d_ns_per_cell_and_stage" + about + by] = 1e9 * seconds / work;
  figures["reach.air3d_tube_volume" + about] = reach::tube_volume<Real>(grid, solver.values());
}

}  // namespace

void bench_reach(Clock& clock, json& figures) {
  constexpr AirGrid coarse{51, 40, 50};
  constexpr AirGrid fine{101, 79, 100};
  const int all_threads = usual_threads();
  for (const int threads : {1, all_threads}) {
    bench_air3d<float>(coarse, threads, clock, figures);
    bench_air3d<double>(coarse, threads, clock, figures);
    bench_air3d<float>(fine, threads, clock, figures);
    bench_air3d<double>(fine, threads, clock, figures);
  }
}

}  // namespace saca::app

// Dynamics of one's own in SACA's reachability solver: from which states can a car that brakes no
// harder than 8 m/s2 still stop before a wall? Built against an installed package:
// find_package(saca).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "saca/lab/levelset/flow_of.h"
#include "saca/lab/levelset/solver.h"

struct Brake {  // x' = v, v' = a, |a| <= strongest
  static constexpr std::size_t dimensions = 2;
  double strongest;
  struct Row {  // cells along the first axis
    double v, strongest;
    template <class N>
    N hamiltonian(const N& /*x*/, const std::array<N, 2>& p) const {
      return v * p[0] - strongest * abs(p[1]);  // the best of all inputs: f . p
    }
    template <class N>
    std::array<N, 2> speeds(const N& /*x*/) const {
      return {std::abs(v), strongest};  // |dH/dp_i| at most, for any gradient
    }
  };
  // x[0] is not set: it goes along the row
  Row row(const std::array<double, 2>& x) const { return {x[1], strongest}; }
};

int main() {
  using namespace saca;
  const Brake brake{.strongest = 8.0};                                                   // [m/s2]
  const danger::Grid grid{{{.name = "x", .first = -20.0, .last = 5.0, .points = 126},    // [m]
                           {.name = "v", .first = -5.0, .last = 15.0, .points = 101}}};  // [m/s]
  // h: how far it stands in the wall, which is all that lies at x >= 0.
  const auto h = danger::sampled<float>(
      grid, [](auto state) { return state[0]; }, 1);
  levelset::Solver<float> solver(grid, levelset::flow_of<float>(grid, brake), h, {});
  while (solver.time() < 2.0) {  // a stop from 15 m/s takes 1.9 s
    if (const auto step = solver.step(2.0); !step.has_value()) {
      std::fprintf(stderr, "%s\n", step.error().message.c_str());
      return 1;
    }
  }

  // In closed form it gets v^2 / (2 strongest) farther, whatever it does.
  int unsafe = 0, wanted = 0, other = 0;
  for (std::size_t i = 0; i < danger::num_cells(grid); ++i) {
    const danger::State state = danger::state_at(grid, i);
    const double v = std::max(0.0, state[1]);
    const bool is_unsafe = solver.values()[i] >= 0.0F;
    const bool is_known_unsafe = state[0] + v * v / (2.0 * brake.strongest) >= 0.0;
    unsafe += is_unsafe ? 1 : 0;
    wanted += is_known_unsafe ? 1 : 0;
    other += is_unsafe != is_known_unsafe ? 1 : 0;
  }
  const double percent = 100.0 / static_cast<double>(danger::num_cells(grid));
  std::printf("unsafe: %.2f %% of the states, in closed form %.2f %%; not the same: %.2f %%\n",
              percent * unsafe, percent * wanted, percent * other);
  return percent * other < 0.5 ? 0 : 1;  // a row's 126 cells are cut once: 0.8 % is one cell each
}

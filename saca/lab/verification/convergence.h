#pragma once

#include <string>
#include <vector>

namespace saca::verification {

/// Errors against a known answer on ever finer grids.
struct Refinement {
  std::string name;              ///< the problem and what solved it
  std::vector<double> spacings;  ///< of the grids, falling [m]
  std::vector<double> errors;    ///< mean size of the error over the cells that count [m]
};

/// Order of convergence from grid to grid: log of the errors' quotient over that of the spacings'.
/// One fewer than there are grids.
[[nodiscard]] std::vector<double> orders(const Refinement& refinement);

/// Problems with answers in closed form (`known_systems.h`), in doubles, each on `grids` grids of
/// which one has half the spacing of the one before:
/// - a smooth value carried along, by each of the differences: their orders are 1, 2, 3 and 5, but
///   that ENO loses some at extrema;
/// - discs that grow and shrink, where nothing is at a kink;
/// - braking before a wall, the running maximum: kinked at v = 0, so of first order in the end.
/// @param grids  2 to 5
[[nodiscard]] std::vector<Refinement> refinements(int grids, int threads);

}  // namespace saca::verification

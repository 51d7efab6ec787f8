#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/levelset/air3d.h"
#include "saca/lab/levelset/flow.h"
#include "saca/lab/levelset/solver.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/grid.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::levelset {

/// What is to be solved, and kept at which times.
struct Problem {
  /// TOML: what a file of the solution says that it answers. It is to tell apart what differs in
  /// more than grid and times.
  std::string text;
  danger::Grid grid;
  std::vector<double> times;  ///< of the snapshots [s], > 0, rising; the last is the horizon
  Tube tube = Tube::highest;
  std::function<double(std::span<const double>)> unsafe;  ///< h of a state
  bool unsafe_alike_last = false;                         ///< h is the same all along the last axis
  std::function<Flow<float>(const danger::Grid&, Differences)> in_floats;
  std::function<Flow<double>(const danger::Grid&, Differences)> in_doubles;
};

/// Mitchell's game, to 2.8 s.
[[nodiscard]] Problem air3d_problem(const danger::Grid& grid, const Air3d& game = {});

/// What a case file asks for.
[[nodiscard]] Problem avoidance_problem(const danger::AvoidanceCase& asked);

struct Scheme {
  Differences differences = Differences::weno5;
  Steps steps = Steps::tvd_rk3;
  double cfl = 0.75;
  bool doubles = false;
  int threads = 1;
  bool with_error = true;  ///< solve on half as many points as well: the difference is the error
};

/// By which tables of danger (danger_cases.h) are solved for runs.
[[nodiscard]] Scheme danger_scheme(int threads);

/// "weno5, rk3, cfl 0.75, floats, solver 1": all on which the values depend but for rounding. The
/// last number rises with each change of the solver that changes values by more than that.
[[nodiscard]] std::string described(const Scheme& scheme);

/// Bytes that `solve` takes at its height, snapshots included, also when it goes on and when each
/// is written to a file (`write_solved`); beside the program itself.
[[nodiscard]] std::size_t memory_needed(const Problem& problem, const Scheme& scheme);

/// Looks on while something is solved.
struct Onlooker {
  /// After each step: how far it is, of the horizon [s]; false stops it.
  std::function<bool(double tau)> step = [](double) { return true; };
  /// After each snapshot and when stopped: what there is so far, to be kept.
  std::function<std::optional<Error>(const danger::Solution&)> keep = [](const danger::Solution&) {
    return std::optional<Error>();
  };
};

/// Solves it, or goes on with what was begun.
///
/// The error of the last snapshot is the difference to the same problem on half as many points
/// along each axis: about the scheme's own error or more, for one that converges in first order at
/// least, as points become many. It is no bound. Of cells whose value is known it was less than the
/// true error, by more than rounding, in none before a wall that a car brakes for (41 points along
/// an axis and more), in 1 to 4 % about discs by weno5, in 12 to 41 % by upwind1; where the two
/// solutions cross it is 0. `ValueTable` takes the greatest error of a cell's corners.
/// @param begun  what `keep` was given before, of the same problem, grid and scheme, for the first
///               of the times. One that is complete for all of them is given back as it is
/// @return       not complete when stopped; an error when a value is no number (it names the cell),
///               when `begun` is of something else (it names both), or `keep` had one
/// @throws       what the system or `unsafe` throws
[[nodiscard]] Result<danger::Solution> solve(const Problem& problem, const Scheme& scheme,
                                             std::optional<danger::Solution> begun,
                                             const Onlooker& onlooker);

}  // namespace saca::levelset

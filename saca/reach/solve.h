#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/core/result.h"
#include "saca/reach/air3d.h"
#include "saca/reach/avoidance_case.h"
#include "saca/reach/flow.h"
#include "saca/reach/grid.h"
#include "saca/reach/solver.h"
#include "saca/reach/value_file.h"

namespace saca::reach {

/// What is to be solved, and kept at which times.
struct Problem {
  std::string text;  ///< TOML: what a file of the solution says that it answers
  Grid grid;
  std::vector<double> times;  ///< of the snapshots [s], > 0, rising; the last is the horizon
  Tube tube = Tube::highest;
  std::function<double(std::span<const double>)> unsafe;  ///< h of a state
  std::function<Flow<float>(const Grid&, Differences)> in_floats;
  std::function<Flow<double>(const Grid&, Differences)> in_doubles;
};

/// Mitchell's game, to 2.8 s.
[[nodiscard]] Problem air3d_problem(const Grid& grid, const Air3d& game = {});

/// What a case file asks for.
/// @param text  of the file
[[nodiscard]] Problem avoidance_problem(const AvoidanceCase& asked, std::string text);

struct Scheme {
  Differences differences = Differences::weno5;
  Steps steps = Steps::tvd_rk3;
  double cfl = 0.75;
  bool doubles = false;
  int threads = 1;
  bool with_error = true;  ///< solve on half as many points as well: the difference is the error
};

/// Bytes that `solve` takes at its height, snapshots included.
[[nodiscard]] std::size_t memory_needed(const Problem& problem, const Scheme& scheme);

/// Looks on while something is solved.
struct Onlooker {
  /// After each step: how far it is, of the horizon [s]; false stops it.
  std::function<bool(double tau)> step = [](double) { return true; };
  /// After each snapshot and when stopped: what there is so far, to be kept.
  std::function<std::optional<Error>(const Solved&)> keep = [](const Solved&) {
    return std::optional<Error>();
  };
};

/// Solves it, or goes on with what was begun.
///
/// The error of the last snapshot is the difference to the same problem on half as many points
/// along each axis: for a scheme that converges at least in first order, no less than its own
/// error.
/// @param begun  what `keep` was given before, of the same problem and precision
/// @return       not complete when stopped; an error when a value is no number (it names the cell),
///               when `begun` is of another problem, or `keep` had one
[[nodiscard]] Result<Solved> solve(const Problem& problem, const Scheme& scheme,
                                   std::optional<Solved> begun, const Onlooker& onlooker);

}  // namespace saca::reach

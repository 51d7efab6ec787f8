#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::tune {

/// A cost to be made small by numbers within bounds.
struct Problem {
  std::string name;  ///< all that the cost depends on: a journal of another one is refused
  std::vector<double> low, high, start;  ///< one each for every number
  std::function<double(const std::vector<double>&)> cost;
};

struct Effort {
  int evaluations = 4000;  ///< most calls of the cost, > 0; a fifth of them polishes
  unsigned long seed = 1;
};

struct Progress {
  int evaluations = 0;
  double best = 0.0;
  bool remembered = false;  ///< read from the journal, not worked out
};

struct Minimum {
  std::vector<double> at;
  double cost = 0.0;
  int evaluations = 0;
};

/// Controlled random search over the whole box, then subplex from the best found.
///
/// Every evaluation is in a journal before the next begins: a kill loses none, a power cut a few. A
/// run that was
/// stopped goes on when it is called again: the search is the same for the same seed, and what the
/// journal remembers is not worked out again. So the end is that of a run that was never stopped.
///
/// @param look  called after each evaluation; false stops
/// @return      nullopt when `look` stopped it; Error::Code::malformed when the journal is of
///              another problem (by name, box or start), effort or seed, naming both; unreadable,
///              unwritable
///
/// Source: W. L. Price, Global optimization by controlled random search, J. Optim. Theory Appl. 40
/// (1983); T. Rowan, Functional stability analysis of numerical algorithms (1990); both from NLopt.
[[nodiscard]] Result<std::optional<Minimum>> minimise(
    const Problem& problem, const Effort& effort, const std::filesystem::path& journal,
    const std::function<bool(const Progress&)>& look);

}  // namespace saca::tune

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/eval/whatif.h"
#include "saca/lab/long_work/progress.h"

namespace saca::policy_study {

constexpr std::size_t most_cells = 40'000;  ///< of one map

/// A map of which policy is best, over one or two numbers of a scenario.
struct WhatifMap {
  const scenario::Scenario* scenario = nullptr;
  const manoeuvre::Car* car = nullptr;
  double time = 0.0;              ///< when all policies begin [s]
  std::vector<eval::Axis> axes;   ///< one or two
  std::vector<eval::Cell> cells;  ///< the first axis fastest
};

/// The axes of a map, as they are typed after --vary: eval::parse_axis.
/// @param texts  one or two
/// @return  Error::Code::malformed: no such number, or twice the same; out_of_range: more than
///          `most_cells` cells
[[nodiscard]] Result<std::vector<eval::Axis>> axes_of(const std::vector<std::string>& texts,
                                                      const scenario::Scenario& scenario);

/// How the cells are worked out.
struct CellsWork {
  int threads = 1;  ///< they do not change the result
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// Tries all policies in every cell, with progress on the error stream.
/// @param map  all but its cells
/// @return     the cells; nullopt: interrupted. Error::Code::out_of_range where no cell can be:
///             why the first of them cannot
[[nodiscard]] Result<std::optional<std::vector<eval::Cell>>> try_cells(
    const WhatifMap& map, const collision::HarmModel& harm, const CellsWork& work);

}  // namespace saca::policy_study

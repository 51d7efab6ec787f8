#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/thinking/danger/value_file.h"

namespace saca::reach_study {

/// What there is to tell of a solved case.
struct SolutionSummary {
  std::string file;
  std::size_t cells = 0;
  std::vector<double> times;  ///< of its snapshots [s], at least one
  double unsafe_share = 0.0;  ///< of the cells: V >= 0 in the last snapshot
  double seconds = 0.0;       ///< that it took
};

[[nodiscard]] SolutionSummary summary_of(const std::string& file, const danger::Solution& solved,
                                         double seconds);

/// Schema `saca.reach_solve/1` (docs/formats.md).
[[nodiscard]] nlohmann::json json_of(const SolutionSummary& summary);

/// One line.
[[nodiscard]] std::string text_of(const SolutionSummary& summary);

}  // namespace saca::reach_study

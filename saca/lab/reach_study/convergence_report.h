#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/verification/convergence.h"

namespace saca::reach_study {

/// reach.check.NAME.order, between the two finest grids, and .error_m on the finest.
/// @param all  each on at least two grids
[[nodiscard]] nlohmann::json json_of(const std::vector<verification::Refinement>& all);

/// A line for each.
[[nodiscard]] std::string text_of(const std::vector<verification::Refinement>& all);

/// SVG of the errors over the spacings: the first four are smooth, the others have kinks.
/// @param all  five to seven
[[nodiscard]] std::string convergence_chart(const std::vector<verification::Refinement>& all);

}  // namespace saca::reach_study

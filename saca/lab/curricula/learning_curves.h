#pragma once

#include <string>
#include <vector>

#include "saca/lab/eval/curriculum_figures.h"
#include "saca/lab/report/chart_svg.h"

namespace saca::curricula {

/// How regret, and the share of forecasts that memory answers, change with the encounters met: a
/// point in the middle of each block of them (eval::blocks_of).
/// @param all  at least one, with as many seeds each
[[nodiscard]] report::ChartSheet learning_curves(const std::vector<eval::Episodes>& all,
                                                 const std::string& suite);

}  // namespace saca::curricula

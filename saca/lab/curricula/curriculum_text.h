#pragma once

#include <string>
#include <vector>

#include "saca/lab/eval/curriculum_figures.h"

namespace saca::curricula {

/// What each method came to over all episodes, and who harms more than whom, for a terminal.
/// @param all  at least one, with as many seeds each
[[nodiscard]] std::string text_of(const std::vector<eval::Episodes>& all);

}  // namespace saca::curricula

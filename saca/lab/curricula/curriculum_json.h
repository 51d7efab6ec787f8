#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/eval/curriculum_figures.h"

namespace saca::curricula {

/// The figures of `saca learn` under "learn.SUITE...." (docs/formats.md).
/// @param all  at least one, with as many seeds each
[[nodiscard]] nlohmann::json json_of(const std::vector<eval::Episodes>& all,
                                     const std::string& suite);

}  // namespace saca::curricula

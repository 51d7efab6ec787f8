#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/eval/curriculum_figures.h"

namespace saca::app {

/// What `saca learn` says of episodes, at least one, of a suite: as figures (docs/formats.md), as a
/// picture, and on the terminal.
[[nodiscard]] nlohmann::json learn_figures(const std::vector<eval::Episodes>& all,
                                           const std::string& suite);
[[nodiscard]] std::string learn_curve(const std::vector<eval::Episodes>& all,
                                      const std::string& suite);
void print_learnt(const std::vector<eval::Episodes>& all);

}  // namespace saca::app

#pragma once

// Episodes by hand, for the tests of this module.

#include <array>
#include <vector>

#include "saca/lab/eval/curriculum_figures.h"

namespace saca::curricula {

/// Harms of eval::curriculum_methods, the best of all plans harming nobody.
inline eval::Episode harming(const std::array<double, eval::curriculum_methods.size()>& harms) {
  eval::Episode episode;
  for (const double harm : harms) {
    episode.row.risk.runs.push_back({.harm = harm});
  }
  return episode;
}

/// Two seeds, two encounters of each. The learner harms by 0.1 less than who is frozen with the
/// first seed, and by 0.1 more with the second; the correction by 0.05 less than the choice, and as
/// much; memory answers one of four forecasts of the first seed, and all of the second. Banks of
/// the learner hold 2 and 3 cases, of the poisoned one 4 and 5.
inline std::vector<eval::Episodes> some_episodes() {
  std::vector<eval::Episodes> all(2);
  for (eval::Episodes& one : all) {
    one.size = {{0, 2, 4}, {0, 3, 5}};
  }
  all[0].of = {harming({0.1, 0.0, 0.1, 0.3, 0.2, 0.1}), harming({0.2, 0.2, 0.2, 0.2, 0.2, 0.2})};
  all[1].of = {harming({0.3, 0.2, 0.3, 0.3, 0.3, 0.1}), harming({0.0, 0.2, 0.2, 0.2, 0.2, 0.2})};
  all[0].of[0].row.risk.runs[1].thinking = {.forecasts = 4, .from_memory = 1, .asked = 2};
  all[1].of[1].row.risk.runs[1].thinking = {.forecasts = 2, .from_memory = 2};
  return all;
}

}  // namespace saca::curricula

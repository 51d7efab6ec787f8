#pragma once

// Rows of a table by hand, for the tests of this module.

#include <cstdint>
#include <utility>
#include <vector>

#include "saca/lab/paper_comparison/reply_clock.h"
#include "saca/lab/paper_comparison/table_figures.h"

namespace saca::paper_comparison {

/// A row in which "saca" and "aeb" lost so much, and "saca" asked so often and had so many replies
/// that came to their end.
inline eval::SuiteRow lost(std::uint64_t number, double saca, double aeb, int asked, int ended) {
  eval::SuiteRow row;
  row.number = number;
  row.family = "made";
  for (const double loss : {saca, aeb}) {
    eval::MethodRun run;
    run.collision_loss = loss;
    run.harm = loss / 10.0;
    row.risk.runs.push_back(std::move(run));
  }
  row.risk.runs[0].thinking = {.forecasts = 3, .asked = asked, .ended = ended};
  return row;
}

/// Twelve encounters of Table III, of which the first ten are few. "saca" loses 0.5 in the first
/// ten and 2 in the others, "aeb" 1 in all; in the first three a model was asked, and two of these
/// times each reply came to its end.
inline suites::SuiteRun some_draws() {
  suites::SuiteRun run;
  run.methods = {"saca", "aeb"};
  for (std::uint64_t k = 0; k < 12; ++k) {
    const int asked = k < 3 ? 2 : 0;
    run.rows.push_back(lost(k, k < 10 ? 0.5 : 2.0, 1.0, asked, k == 2 ? 1 : asked));
  }
  return run;
}

inline TableFigures some_figures() {
  return table_figures(*eval::find_paper_table("table_3"), some_draws(), 10, 1);
}

/// Replies of the model in the scenes of Table III.
inline TimedModel some_replies() {
  return {.table = "table_3",
          .title = "the model",
          .key = "model",
          .times = {.asked = 20,
                    .done = 18,
                    .ended = 17,
                    .in_time = 12,
                    .tokens = {.value = 110.4, .low = 100.0, .high = 112.0, .n = 10},
                    .seconds = {.value = 3.26, .low = 3.0, .high = 3.5, .n = 10},
                    .least_seconds = 2.75}};
}

}  // namespace saca::paper_comparison

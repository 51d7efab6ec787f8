#pragma once

// Rows and runs of suites by hand, for the tests of this module.

#include <string>
#include <utility>
#include <vector>

#include "saca/lab/suites/suite_run.h"

namespace saca::suites {

/// An encounter in which methods suffered so much, and the best of all plans `best`.
inline eval::SuiteRow made_row(std::uint64_t number, std::string family,
                               const std::vector<double>& harms, double best) {
  eval::SuiteRow row;
  row.number = number;
  row.family = std::move(family);
  row.risk.best_harm = best;
  row.risk.published_best_harm = best;
  row.risk.best = manoeuvre::Plan{manoeuvre::PolicyId::aes_left, std::nullopt};
  row.risk.tried = {{{manoeuvre::PolicyId::no_intervention, std::nullopt}, 1.0, true}};
  for (const double harm : harms) {
    eval::MethodRun run;
    run.harm = harm;
    run.acted_at = 1.0;
    run.plan = manoeuvre::Plan{manoeuvre::PolicyId::aeb, std::nullopt};
    row.risk.runs.push_back(run);
  }
  return row;
}

/// One that could not be played.
inline eval::SuiteRow failed_row(std::uint64_t number, std::string family, std::string fault) {
  eval::SuiteRow row;
  row.number = number;
  row.family = std::move(family);
  row.fault = std::move(fault);
  return row;
}

/// Rows as if they had been run. No encounter can be drawn again.
inline SuiteRun made_run(std::vector<std::string> methods, std::vector<eval::SuiteRow> rows) {
  SuiteRun run;
  run.methods = std::move(methods);
  run.rows = std::move(rows);
  run.meta = {{"meta.command", "saca suite made"}, {"meta.seed", "1"}};
  run.encounter_at = [](std::uint64_t) -> Result<eval::SuiteEncounter> {
    return Error{Error::Code::out_of_range, "made by hand"};
  };
  run.tried_in = [](const eval::SuiteEncounter&) { return std::nullopt; };
  return run;
}

}  // namespace saca::suites

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/ladder.h"

namespace saca::suites {

/// What `saca ladder --json` prints: figures under the names of docs/formats.md.
/// @param name  of the suite, without folders
[[nodiscard]] nlohmann::json ladder_json(const SuiteRun& run,
                                         const std::vector<RungFigures>& climbed,
                                         const std::string& name);

/// What it prints for people: a line for each rung, and what went wrong.
/// @param suite    as it was named
/// @param climbed  at least one
[[nodiscard]] std::string ladder_text(const SuiteRun& run, const std::vector<RungFigures>& climbed,
                                      const std::string& suite);

/// Its page: regret of each rung, what each step costs, where decisions came from.
/// @param name  as above
[[nodiscard]] report::SuitePage ladder_page(const SuiteRun& run,
                                            const std::vector<RungFigures>& climbed,
                                            const std::string& name);

}  // namespace saca::suites

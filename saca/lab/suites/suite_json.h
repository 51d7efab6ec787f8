#pragma once

#include <nlohmann/json.hpp>

#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::suites {

/// What `saca suite --json` prints: figures under the names of docs/formats.md.
/// @param result  of `run`
[[nodiscard]] nlohmann::json json_of(const SuiteRun& run, const SuiteResult& result,
                                     const SuiteRequest& request);

}  // namespace saca::suites

#pragma once

#include <string>

#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::suites {

/// What `saca suite` prints for people: a line for each method, where decisions of those that think
/// ahead came from, recorded drivers, and how fast it went.
/// @param result  of `run`
[[nodiscard]] std::string text_of(const SuiteRun& run, const SuiteResult& result,
                                  const SuiteRequest& request);

}  // namespace saca::suites

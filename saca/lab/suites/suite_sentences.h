#pragma once

#include <string>
#include <vector>

#include "saca/lab/suites/suite_result.h"

namespace saca::suites {

/// What there is to see in a suite: the first method held against emergency braking, if that was
/// run, where it is better, what it loses, and who of those that a road allows loses least.
/// @param result  of `run`, with figures of each method
[[nodiscard]] std::vector<std::string> sentences_of(const SuiteRun& run, const SuiteResult& result);

}  // namespace saca::suites

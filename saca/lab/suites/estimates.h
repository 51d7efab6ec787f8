#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/eval/suite_figures.h"

namespace saca::suites {

/// A mean with its interval, for readers; "-" where there is none.
/// @param digits  behind the point
/// @param factor  of all three numbers: 100 for per cent
[[nodiscard]] std::string with_interval(const eval::Estimate& estimate, int digits,
                                        double factor = 1.0);

/// A share with one digit, in per cent; "-" where there is none.
[[nodiscard]] std::string percent_of(const eval::Estimate& estimate);

/// Under its name, with .lo, .hi and .n; nothing where nothing counts.
void add_estimate(nlohmann::json& out, const std::string& name, const eval::Estimate& estimate);

}  // namespace saca::suites

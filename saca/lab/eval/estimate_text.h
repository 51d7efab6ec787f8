#pragma once

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/eval/suite_figures.h"

namespace saca::eval {

/// A mean with its interval, for readers: "0.25 (0.10 to 0.40)"; "-" where nothing counts.
/// @param digits  after the point
/// @param factor  of all three, e.g. 100 for per cent
[[nodiscard]] inline std::string with_interval(const Estimate& estimate, int digits,
                                               double factor = 1.0) {
  return estimate.n == 0
             ? "-"
             : fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", factor * estimate.value, digits,
                           factor * estimate.low, digits, factor * estimate.high, digits);
}

/// A share with one digit, in per cent; "-" where nothing counts.
[[nodiscard]] inline std::string percent_of(const Estimate& estimate) {
  return estimate.n == 0 ? "-" : fmt::format("{:.1f}", 100.0 * estimate.value);
}

/// Under its name, with .lo, .hi and .n; nothing where nothing counts.
inline void add_estimate(nlohmann::json& out, const std::string& name, const Estimate& estimate) {
  if (estimate.n == 0) {
    return;
  }
  out[name] = estimate.value;
  out[name + ".lo"] = estimate.low;
  out[name + ".hi"] = estimate.high;
  out[name + ".n"] = estimate.n;
}

}  // namespace saca::eval

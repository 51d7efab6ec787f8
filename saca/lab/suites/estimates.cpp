#include "saca/lab/suites/estimates.h"

#include <fmt/core.h>

namespace saca::suites {

std::string with_interval(const eval::Estimate& estimate, int digits, double factor) {
  return estimate.n == 0
             ? "-"
             : fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", factor * estimate.value, digits,
                           factor * estimate.low, digits, factor * estimate.high, digits);
}

std::string percent_of(const eval::Estimate& estimate) {
  return estimate.n == 0 ? "-" : fmt::format("{:.1f}", 100.0 * estimate.value);
}

void add_estimate(nlohmann::json& out, const std::string& name, const eval::Estimate& estimate) {
  if (estimate.n == 0) {
    return;
  }
  out[name] = estimate.value;
  out[name + ".lo"] = estimate.low;
  out[name + ".hi"] = estimate.high;
  out[name + ".n"] = estimate.n;
}

}  // namespace saca::suites

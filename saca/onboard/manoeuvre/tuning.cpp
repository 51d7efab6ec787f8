#include "saca/onboard/manoeuvre/tuning.h"

#include <algorithm>

namespace saca::manoeuvre {

SpeedRange drift_speeds(const DriftDomain& domain, double grip) noexcept {
  const auto& grips = DriftDomain::grips;
  const auto above = std::upper_bound(grips.begin(), grips.end(), grip);
  if (above == grips.begin()) {
    return {domain.slowest.front(), domain.fastest.front()};
  }
  if (above == grips.end()) {
    return {domain.slowest.back(), domain.fastest.back()};
  }
  const auto i = static_cast<std::size_t>(above - grips.begin());
  constexpr SpeedRange nowhere{fastest, 0.0};
  if (domain.slowest[i - 1] > domain.fastest[i - 1] || domain.slowest[i] > domain.fastest[i]) {
    return nowhere;
  }
  const double share = (grip - grips[i - 1]) / (grips[i] - grips[i - 1]);
  const auto between = [&](const auto& values) {
    return values[i - 1] + share * (values[i] - values[i - 1]);
  };
  return {between(domain.slowest), between(domain.fastest)};
}

}  // namespace saca::manoeuvre

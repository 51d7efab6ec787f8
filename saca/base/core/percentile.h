#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca {

/// Nearest-rank percentile: the smallest value that at least `share` of all do not exceed.
/// @param values  at least one
/// @param share   in [0, 1]
[[nodiscard]] inline double percentile(std::vector<double> values, double share) {
  expects(!values.empty() && share >= 0.0 && share <= 1.0, "values, and a share in [0, 1]");
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace saca

#pragma once

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca {

/// A share that was counted, with its 95 % interval.
struct Proportion {
  double share = 0.0;  ///< in [0, 1]
  double low = 0.0;
  double high = 1.0;
};

/// Source: E. B. Wilson, Probable inference, the law of succession, and statistical inference,
/// J. Am. Stat. Assoc. 22 (1927): the score interval.
/// @param hits   in [0, count]
/// @param count  > 0
[[nodiscard]] inline Proportion proportion(int hits, int count) {
  expects(count > 0 && hits >= 0 && hits <= count, "0 <= hits <= count, count > 0");
  constexpr double z = 1.959964;  // of the normal distribution, two-sided 95 %
  const double n = count;
  const double share = hits / n;
  const double middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half =
      z / (1.0 + z * z / n) * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  return {share, middle - half, middle + half};
}

}  // namespace saca

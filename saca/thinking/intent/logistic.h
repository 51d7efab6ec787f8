#pragma once

#include <cmath>

namespace saca::intent {

/// Rises from `low` to `high`, half of the way at `mark`, about twice `spread` to either side of
/// it.
[[nodiscard]] inline double rising(double low, double high, double value, double mark,
                                   double spread) {
  return low + (high - low) / (1.0 + std::exp(-(value - mark) / spread));
}

}  // namespace saca::intent

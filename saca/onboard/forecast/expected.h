#pragma once

#include <span>

#include "saca/base/core/proportion.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::forecast {

/// A mean with its 95 % interval by Student's t: exact for normal values, good for many draws of
/// any.
struct Mean {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// @param values  two at least, all finite
[[nodiscard]] Mean mean(std::span<const double> values);

/// Two-sided 95 % point of Student's distribution.
/// @param freedom  degrees, >= 1
///
/// Exact for 1 and 2; beyond, the series in Abramowitz, Stegun, Handbook of mathematical functions,
/// 1964, 26.7.5: off by 0.2 % for 3, by less than 0.01 % from 6 on.
[[nodiscard]] double student_t(int freedom);

/// What a policy leads to over draws of what is not known.
struct MeanOutcome {
  Mean harm;
  Mean collision_loss;
  Proportion contact;  ///< share of draws, Wilson's interval
};

/// @param outcomes  one per draw, two at least
[[nodiscard]] MeanOutcome expected(std::span<const collision::Outcome> outcomes);

/// Mean of the harm of `a` minus that of `b`, draw by draw. With the same draws for both, what both
/// suffer alike falls out, and the interval is narrower than those of the two means.
/// @param a, b  of the same draws, in the same order
[[nodiscard]] Mean harm_difference(std::span<const collision::Outcome> a,
                                   std::span<const collision::Outcome> b);

}  // namespace saca::forecast

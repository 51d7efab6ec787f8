#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace saca {

/// A number as a person would write it: to 12 significant digits, so that 3 times 0.2 is 0.6 and
/// not 0.6000000000000001; what is nearer to 0 than 1e-12 is 0. For what people read, not for what
/// must come back to the last bit.
inline double short_number(double value) {
  constexpr double nothing = 1e-12;
  if (std::abs(value) < nothing) {
    return 0.0;
  }
  char text[40];  // NOLINT(*-avoid-c-arrays): for snprintf
  (void)std::snprintf(text, sizeof text, "%.12g", value);
  return std::strtod(text, nullptr);
}

}  // namespace saca

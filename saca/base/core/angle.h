#pragma once

#include <cmath>
#include <numbers>

namespace saca {

/// The same direction in (-pi, pi] [rad].
inline double wrap_angle(double angle) {
  if (angle > -std::numbers::pi && angle <= std::numbers::pi) {
    return angle;  // nearly always, and the remainder is slow
  }
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2.0 * std::numbers::pi : wrapped;
}

}  // namespace saca

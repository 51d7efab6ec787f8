#pragma once

namespace saca {

// The polynomial of fifth order that leads from 0 to 1 without slope and curvature at its ends; it
// is 0 before them and 1 after. A move to the side as people make it.

inline double quintic(double x) {
  return x <= 0.0 ? 0.0 : x >= 1.0 ? 1.0 : x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}
inline double quintic_slope(double x) {
  return x <= 0.0 || x >= 1.0 ? 0.0 : 30.0 * x * x * (1.0 - x) * (1.0 - x);
}
inline double quintic_curvature(double x) {
  return x <= 0.0 || x >= 1.0 ? 0.0 : 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x);
}

}  // namespace saca

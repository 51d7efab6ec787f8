#pragma once

#include <numbers>

namespace saca {

// Conversion at the edges: inside the library every number is SI.

constexpr double from_kmh(double speed) {
  return speed / 3.6;
}
constexpr double to_kmh(double speed) {
  return speed * 3.6;
}
/// International mile: 1609.344 m exactly.
constexpr double from_mph(double speed) {
  return speed * 0.44704;
}
/// International foot: 0.3048 m exactly.
constexpr double from_feet(double length) {
  return length * 0.3048;
}
/// International inch: 0.0254 m exactly.
constexpr double from_inches(double length) {
  return length * 0.0254;
}
/// Standard gravity: 9.80665 m/s^2 exactly.
constexpr double from_g(double acceleration) {
  return acceleration * 9.80665;
}
constexpr double from_degrees(double angle) {
  return angle * (std::numbers::pi / 180.0);
}
constexpr double to_degrees(double angle) {
  return angle * (180.0 / std::numbers::pi);
}

}  // namespace saca

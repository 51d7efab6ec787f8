#pragma once

#include <algorithm>
#include <cmath>

/// What equations that are written for any number type need beside arithmetic, for `double`.
///
/// A pack of numbers, one for each of several cars, brings its own functions of these names; they
/// are found beside its type. A comparison of packs gives a mask where one of doubles gives a bool.
/// `mask && mask`, `mask || mask` and `!mask` are right for both.
namespace saca::number {

/// `a` where the mask holds, elsewhere `b`; both are computed.
constexpr double select(bool mask, double a, double b) noexcept {
  return mask ? a : b;
}
/// Whether a mask holds anywhere; everywhere. Skips work that no car, or no more cars, need.
constexpr bool any(bool mask) noexcept {
  return mask;
}
constexpr bool all(bool mask) noexcept {
  return mask;
}

constexpr double min(double a, double b) noexcept {
  return std::min(a, b);
}
constexpr double max(double a, double b) noexcept {
  return std::max(a, b);
}
constexpr double clamp(double value, double low, double high) noexcept {
  return std::clamp(value, low, high);
}
inline double abs(double value) noexcept {
  return std::abs(value);
}
inline double round(double value) noexcept {
  return std::round(value);
}
inline double sqrt(double value) noexcept {
  return std::sqrt(value);
}
inline double hypot(double x, double y) noexcept {
  return std::hypot(x, y);
}
inline double cos(double angle) noexcept {
  return std::cos(angle);
}
inline double sin(double angle) noexcept {
  return std::sin(angle);
}
inline double tan(double angle) noexcept {
  return std::tan(angle);
}
inline double asin(double value) noexcept {
  return std::asin(value);
}
inline double atan2(double y, double x) noexcept {
  return std::atan2(y, x);
}

}  // namespace saca::number

#pragma once

#include <cmath>

#include "saca/base/core/direction.h"

namespace saca {

/// A planar vector. Its unit and the frame it is expressed in are part of the variable's name or
/// comment (p_W, v_B), not of the type.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator-(Vec2 a) {
  return {-a.x, -a.y};
}
constexpr Vec2 operator*(double s, Vec2 a) {
  return {s * a.x, s * a.y};
}
constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
inline double norm(Vec2 a) {
  return std::sqrt(dot(a, a));  // std::hypot is slower, and lengths of this world do not overflow
}
inline bool is_finite(Vec2 a) {
  return std::isfinite(a.x) && std::isfinite(a.y);
}

/// Turns `a` by `angle` [rad], counter-clockwise.
inline Vec2 rotated(Vec2 a, double angle) {
  const auto [c, s] = direction(angle);
  return {c * a.x - s * a.y, s * a.x + c * a.y};
}

}  // namespace saca

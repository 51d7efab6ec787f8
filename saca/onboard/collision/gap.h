#pragma once

#include <array>
#include <limits>

#include "saca/base/core/pose.h"
#include "saca/base/world/footprint.h"

namespace saca::collision {

/// A footprint somewhere, its direction as cosine and sine.
struct Body {
  bool round = false;
  Vec2 half;    ///< axes [m]
  Vec2 centre;  ///< [m]
  Vec2 along;   ///< unit vector
};

[[nodiscard]] Body body_at(const world::Footprint& footprint, const Pose& X_WB) noexcept;

/// A quarter turn to the left.
[[nodiscard]] constexpr Vec2 left_of(Vec2 a) noexcept {
  return {-a.y, a.x};
}

/// The widest gap along some directions: never more than the distance; of boxes that overlap, how
/// deep.
struct Gap {
  double size = -std::numeric_limits<double>::infinity();  ///< [m]; infinite where a body is none
  Vec2 n;                                                  ///< from a to b
};

/// Along each axis of `a` and of `b`: length, width, length, width.
[[nodiscard]] std::array<Gap, 4> gaps_along_axes(const Body& a, const Body& b) noexcept;

/// Along the axes of both, and of what is round towards the nearest point of the other: with two
/// boxes at least 0 exactly when they do not overlap.
[[nodiscard]] Gap gap_between(const Body& a, const Body& b) noexcept;

}  // namespace saca::collision

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "saca/base/core/pose.h"

namespace saca::world {

/// The ground that a body covers: a convex shape fixed to the body's frame.
enum class Shape : std::uint8_t {
  box,      ///< length x width
  ellipse,  ///< full axes length and width; equal axes make a disc
  segment,  ///< a straight line of that length along x_B: a wall, an edge of a polygon
};

/// "box", "ellipse", "segment".
[[nodiscard]] std::string_view name(Shape shape);
[[nodiscard]] std::optional<Shape> shape_from(std::string_view name);

struct Footprint {
  Shape shape = Shape::box;
  double length = 0.0;    ///< along x_B [m], > 0
  double width = 0.0;     ///< along y_B [m], > 0; a segment has none: 0, and not used
  double centre_x = 0.0;  ///< of the shape's centre ahead of the body's origin [m]

  bool operator==(const Footprint&) const = default;
};

/// Half its extent along x_B and y_B about the shape's centre [m].
[[nodiscard]] Vec2 half_axes(const Footprint& footprint);

/// Point of the footprint that lies farthest in a direction.
/// @param direction_W  any length but zero
/// @return             p_W [m]
[[nodiscard]] Vec2 support(const Footprint& footprint, const Pose& X_WB, Vec2 direction_W);

/// Radius of the smallest disc about the body's origin that holds the footprint [m].
[[nodiscard]] double bounding_radius(const Footprint& footprint);

/// Shortest way between two footprints.
struct Separation {
  double distance = 0.0;  ///< [m], 0 when they touch or overlap
  Vec2 p_a_W;             ///< nearest point of the first; meaningless while they overlap
  Vec2 p_b_W;             ///< nearest point of the second; likewise
};

/// Exact up to `1e-6` m; allocates nothing.
/// @throws ContractViolation  if a size is not > 0 or a pose is not finite
[[nodiscard]] Separation separation(const Footprint& a, const Pose& X_WA, const Footprint& b,
                                    const Pose& X_WB);

}  // namespace saca::world

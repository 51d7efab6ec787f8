#pragma once

#include <cstdint>
#include <string_view>

#include "saca/base/core/vec2.h"
#include "saca/base/world/footprint.h"

namespace saca::collision {

/// The side of a body that is struck.
enum class Face : std::uint8_t { front, left, right, rear };
[[nodiscard]] std::string_view name(Face face);

/// The face that an impact from the direction of `out_B` meets.
///
/// @param out_B  outward normal of the contact in the body's frame, not zero
///
/// Box: the face whose normal lies within 45 degrees of `out_B`. Where a face is touched this is
/// that face; where a corner is touched, `out_B` is normal to what it runs into, and the corner
/// counts to the face that looks there. Ellipse: the quarter, between the diagonals of its bounding
/// box, that holds the touched point. On the dividing line: front or rear.
[[nodiscard]] Face struck_face(const world::Footprint& footprint, Vec2 out_B);

}  // namespace saca::collision

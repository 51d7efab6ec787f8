#include "saca/onboard/collision/face.h"

#include <array>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"

namespace saca::collision {

std::string_view name(Face face) {
  constexpr std::array<std::string_view, 4> names{"front", "left", "right", "rear"};
  return name_of(face, names);
}

Face struck_face(const world::Footprint& footprint, Vec2 out_B) {
  expects(is_finite(out_B) && dot(out_B, out_B) > 0.0, "out_B is not zero");
  // The point of an ellipse with normal n is (a^2 nx, b^2 ny) / h; over its half axes: (a nx, b
  // ny).
  const bool ellipse = footprint.shape == world::Shape::ellipse;
  const double along = std::abs(out_B.x) * (ellipse ? footprint.length : 1.0);
  const double across = std::abs(out_B.y) * (ellipse ? footprint.width : 1.0);
  if (along >=
      across * (1.0 - 1e-9)) {  // rounding must not tell a mirrored scene from its original
    return out_B.x >= 0.0 ? Face::front : Face::rear;
  }
  return out_B.y > 0.0 ? Face::left : Face::right;
}

}  // namespace saca::collision

#include "saca/onboard/collision/gap.h"

#include <algorithm>
#include <cmath>

namespace saca::collision {
namespace {

// How far the body reaches along a unit vector.
double reach_along(const Body& body, Vec2 n) noexcept {
  const double x = body.half.x * dot(n, body.along);
  const double y = body.half.y * dot(n, left_of(body.along));
  return body.round ? std::sqrt(x * x + y * y) : std::abs(x) + std::abs(y);
}

void look_along(const Body& a, const Body& b, Vec2 n, Gap& gap) noexcept {
  const double apart = dot(b.centre - a.centre, n);
  const double size = std::abs(apart) - reach_along(a, n) - reach_along(b, n);
  if (size > gap.size) {
    gap = {size, apart < 0.0 ? -n : n};
  }
}

// The same for all four axes of two boxes.
void look_along_axes(const Body& a, const Body& b, Gap& gap) noexcept {
  const Vec2 way = b.centre - a.centre;
  const double c = std::abs(dot(a.along, b.along));
  const double s = std::abs(dot(left_of(a.along), b.along));
  const auto keep = [&](double apart, double reach, Vec2 n) {
    const double size = std::abs(apart) - reach;
    if (size > gap.size) {
      gap = {size, apart < 0.0 ? -n : n};
    }
  };
  const Vec2 a_left = left_of(a.along);
  const Vec2 b_left = left_of(b.along);
  keep(dot(way, a.along), a.half.x + b.half.x * c + b.half.y * s, a.along);
  keep(dot(way, a_left), a.half.y + b.half.x * s + b.half.y * c, a_left);
  keep(dot(way, b.along), b.half.x + a.half.x * c + a.half.y * s, b.along);
  keep(dot(way, b_left), b.half.y + a.half.x * s + a.half.y * c, b_left);
}

// From the nearest point of a box to the middle of what is round.
void look_from_box(const Body& box, const Body& round, const Body& a, const Body& b,
                   Gap& gap) noexcept {
  const Vec2 way = round.centre - box.centre;
  const Vec2 across = left_of(box.along);
  const double x = dot(way, box.along);
  const double y = dot(way, across);
  const Vec2 off = (x - std::clamp(x, -box.half.x, box.half.x)) * box.along +
                   (y - std::clamp(y, -box.half.y, box.half.y)) * across;
  const double size = std::sqrt(dot(off, off));
  if (size > 0.0) {
    look_along(a, b, (1.0 / size) * off, gap);
  }
}

}  // namespace

Body body_at(const world::Footprint& footprint, const Pose& X_WB) noexcept {
  const Vec2 along{std::cos(X_WB.yaw), std::sin(X_WB.yaw)};
  return {footprint.shape == world::Shape::ellipse, half_axes(footprint),
          X_WB.p + footprint.centre_x * along, along};
}

std::array<Gap, 4> gaps_along_axes(const Body& a, const Body& b) noexcept {
  std::array<Gap, 4> gaps;
  look_along(a, b, a.along, gaps[0]);
  look_along(a, b, left_of(a.along), gaps[1]);
  look_along(a, b, b.along, gaps[2]);
  look_along(a, b, left_of(b.along), gaps[3]);
  return gaps;
}

Gap gap_between(const Body& a, const Body& b) noexcept {
  Gap gap;
  if (!a.round && !b.round) {
    look_along_axes(a, b, gap);
  } else {
    look_along(a, b, a.along, gap);
    look_along(a, b, left_of(a.along), gap);
    look_along(a, b, b.along, gap);
    look_along(a, b, left_of(b.along), gap);
  }
  if (b.round) {
    look_from_box(a, b, a, b, gap);
  }
  if (a.round) {
    look_from_box(b, a, a, b, gap);
  }
  if (!(gap.size > -std::numeric_limits<double>::infinity())) {
    gap.size = std::numeric_limits<double>::infinity();  // what is no number touches nobody
  }
  return gap;
}

}  // namespace saca::collision

#include "saca/base/world/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"

namespace saca::world {
namespace {

constexpr std::array<std::string_view, 3> shape_names{"box", "ellipse", "segment"};

double length_of(Vec2 a) {
  return std::sqrt(dot(a, a));  // std::hypot is slower, and these lengths cannot overflow
}
Vec2 left_of(Vec2 a) {
  return {-a.y, a.x};
}

// A rotation kept as cosine and sine, so that it is paid for once.
struct Turn {
  double c = 1.0;
  double s = 0.0;
};
Turn turn_by(double angle) {
  const Direction at = direction(angle);
  return {at.cosine, at.sine};
}
Vec2 operator*(Turn turn, Vec2 a) {
  return {turn.c * a.x - turn.s * a.y, turn.s * a.x + turn.c * a.y};
}
Turn inverse(Turn turn) {
  return {turn.c, -turn.s};
}

// A footprint about its own centre: half axes, and how its axes stand in the frame of the work. A
// segment is a box that has no width.
struct Body {
  Shape shape = Shape::box;
  double a = 0.0;  ///< half the length [m]
  double b = 0.0;  ///< half the width [m]
  Vec2 centre;
  Turn turn;
};

// Point of the body, from its centre, that lies farthest along n.
Vec2 farthest(const Body& body, Vec2 n) {
  const Vec2 m = inverse(body.turn) * n;
  if (body.shape != Shape::ellipse) {
    return body.turn * Vec2{std::copysign(body.a, m.x), std::copysign(body.b, m.y)};
  }
  const Vec2 scaled{body.a * m.x, body.b * m.y};
  const double h = length_of(scaled);
  return body.turn * Vec2{body.a * scaled.x / h, body.b * scaled.y / h};
}

// Radius of curvature of the boundary where its outward normal is the unit vector n; 0 at a corner.
double curvature_radius(const Body& body, Vec2 n) {
  if (body.shape != Shape::ellipse) {
    return 0.0;
  }
  const Vec2 m = inverse(body.turn) * n;
  const double h = length_of({body.a * m.x, body.b * m.y});
  return body.a * body.a * body.b * body.b / (h * h * h);
}

// Two bodies, a pair of their points that face each other along the unit vector n (from the first
// to the second), and the gap between the two lines through them that are normal to n.
struct Facing {
  Vec2 n;
  Vec2 p_a;
  Vec2 p_b;
  double gap = 0.0;

  [[nodiscard]] Vec2 between() const { return p_b - p_a; }
};

Facing facing(const Body& a, const Body& b, Vec2 n) {
  const Vec2 p_a = a.centre + farthest(a, n);
  const Vec2 p_b = b.centre + farthest(b, -n);
  return {n, p_a, p_b, dot(n, p_b - p_a)};
}

Vec2 unit(Vec2 a) {
  return (1.0 / length_of(a)) * a;
}

// A direction along which the bodies are apart; gap <= 0 when there is none, so they touch.
//
// The vectors `between()` are the near boundary of the Minkowski difference B - A, which holds the
// vector d from centre to centre. Two of them, one on either side of the line along d, make a
// portal; the bodies overlap exactly if the origin lies behind the last portal (Snethen,
// "XenoCollide", Game Programming Gems 7, 2008, in the plane).
Facing apart(const Body& a, const Body& b) {
  const Vec2 d = b.centre - a.centre;
  const double distance = length_of(d);
  if (distance <= 0.0) {
    return {};
  }
  const Vec2 along = (1.0 / distance) * d;
  const Vec2 across = left_of(along);
  Facing now = facing(a, b, along);
  // The widest portal: seen across the line of centres.
  Vec2 left = facing(a, b, -across).between();
  Vec2 right = facing(a, b, across).between();
  for (int i = 0; i < 64 && now.gap <= 0.0; ++i) {
    const Vec2 middle = now.between();
    (dot(middle, across) > 0.0 ? left : right) = middle;
    const Vec2 portal =
        left - right;  // points to the left, so its right-hand normal is `towards d`
    const Vec2 n = Vec2{portal.y, -portal.x};
    const double size = length_of(n);
    if (!(size > 0.0) || dot(n, left) <= 0.0) {
      return now;  // the portal lies behind the origin: overlap is certain
    }
    now = facing(a, b, (1.0 / size) * n);
    if (dot(now.n, left) - now.gap <= 1e-13 * (distance + size)) {
      return now;  // the boundary itself: the gap's sign is the answer
    }
  }
  return now;
}

// The direction of the widest gap, which is the distance, found from one where there is a gap.
//
// In the angle of n the gap f obeys f'' = -f - (sum of the radii of curvature): concave where f >
// 0, so that Newton's method, kept inside a bracket, finds its only maximum.
Facing widest(const Body& a, const Body& b, Facing now) {
  const Vec2 along = unit(b.centre - a.centre);
  Vec2 low = {along.y, -along.x};   // clockwise end: no gap beyond a right angle to the centres
  Vec2 high = {-along.y, along.x};  // counter-clockwise end
  Facing best = now;
  for (int i = 0; i < 96; ++i) {
    const Vec2 t = left_of(now.n);
    const double slope = dot(now.between(), t);
    if (now.gap > best.gap) {
      best = now;
    }
    const double bend = now.gap + curvature_radius(a, now.n) + curvature_radius(b, now.n);
    if (now.gap > 0.0 && std::abs(slope) <= 1e-12 * bend + 1e-14 * now.gap) {
      return now;
    }
    // A gap <= 0 says only that the step went too far from `best`, to the side it stands on.
    const bool ahead = now.gap > 0.0 ? slope > 0.0 : dot(left_of(now.n), best.n) > 0.0;
    (ahead ? low : high) = now.n;
    Vec2 next = unit(now.n + (slope / bend) * t);
    const bool inside = dot(left_of(low), next) > 0.0 && dot(left_of(next), high) > 0.0;
    // Once Newton has had its chance, every third step halves the bracket, so that it shrinks
    // whatever the curvature does.
    if (!(now.gap > 0.0) || !inside || (i > 6 && i % 3 == 2)) {
      const Vec2 middle = low + high;
      const double size = length_of(middle);
      next = size > 1e-9 ? (1.0 / size) * middle : left_of(low);
    }
    now = facing(a, b, next);
  }
  return best;
}

// The gap along a face of the box, when the ellipse's nearest point lies in front of that face.
bool faces_box(const Body& box, const Body& ellipse, Facing& result) {
  const Vec2 centre = inverse(box.turn) * (ellipse.centre - box.centre);
  const Vec2 side{std::copysign(1.0, centre.x), std::copysign(1.0, centre.y)};
  const std::array<Vec2, 2> normals{Vec2{side.x, 0.0}, Vec2{0.0, side.y}};
  for (const Vec2 normal : normals) {
    const Vec2 n = box.turn * normal;
    const Vec2 p = inverse(box.turn) * (ellipse.centre + farthest(ellipse, -n) - box.centre);
    const bool along_x = normal.x != 0.0;
    const double gap = along_x ? std::abs(p.x) - box.a : std::abs(p.y) - box.b;
    const bool in_front = along_x ? std::abs(p.y) <= box.b : std::abs(p.x) <= box.a;
    if (gap > 0.0 && in_front && dot(normal, p) > 0.0) {
      const Vec2 foot = along_x ? Vec2{side.x * box.a, p.y} : Vec2{p.x, side.y * box.b};
      result = {n, box.centre + box.turn * foot, box.centre + box.turn * p, gap};
      return true;
    }
  }
  return false;
}

Separation with_ellipse(const Body& a, const Body& b) {
  Facing found;
  if (a.shape != Shape::ellipse && faces_box(a, b, found)) {
    return {found.gap, found.p_a, found.p_b};
  }
  if (b.shape != Shape::ellipse && faces_box(b, a, found)) {
    return {found.gap, found.p_b, found.p_a};
  }
  found = apart(a, b);
  if (!(found.gap > 0.0)) {
    return {};
  }
  found = widest(a, b, found);
  // The ellipse's point and n leave no doubt about the other point, not even where n has stopped
  // between a face and its corner, or where the gap is no wider than what rounding moves a point.
  if (a.shape == Shape::ellipse) {
    return {found.gap, found.p_a, found.p_a + found.gap * found.n};
  }
  return {found.gap, found.p_b - found.gap * found.n, found.p_b};
}

// Is there no gap along any normal of the first box?
bool overlap_along_axes(const Body& box, const Body& other) {
  const Vec2 centre = inverse(box.turn) * (other.centre - box.centre);
  const double c = std::abs(box.turn.c * other.turn.c + box.turn.s * other.turn.s);
  const double s = std::abs(box.turn.c * other.turn.s - box.turn.s * other.turn.c);
  return std::abs(centre.x) <= box.a + other.a * c + other.b * s &&
         std::abs(centre.y) <= box.b + other.a * s + other.b * c;
}

struct Nearest {
  double square = std::numeric_limits<double>::infinity();  ///< of the distance [m^2]
  Vec2 corner;                                              ///< of the other box
  Vec2 foot;                                                ///< on the box
};

// The corner of `other` that lies nearest to `box`.
Nearest nearest_corner(const Body& box, const Body& other) {
  const Vec2 centre = inverse(box.turn) * (other.centre - box.centre);
  const Turn turn{box.turn.c * other.turn.c + box.turn.s * other.turn.s,
                  box.turn.c * other.turn.s - box.turn.s * other.turn.c};
  const std::array<Vec2, 4> corners{Vec2{other.a, other.b}, Vec2{-other.a, other.b},
                                    Vec2{-other.a, -other.b}, Vec2{other.a, -other.b}};
  Nearest nearest;
  for (const Vec2 corner : corners) {
    const Vec2 p = centre + turn * corner;
    const Vec2 foot{std::clamp(p.x, -box.a, box.a), std::clamp(p.y, -box.b, box.b)};
    const double square = dot(p - foot, p - foot);
    if (square < nearest.square) {
      nearest = {square, p, foot};
    }
  }
  nearest.corner = box.centre + box.turn * nearest.corner;
  nearest.foot = box.centre + box.turn * nearest.foot;
  return nearest;
}

// Two polygons that do not overlap are nearest at a corner of one of them.
Separation between_boxes(const Body& a, const Body& b) {
  if (overlap_along_axes(a, b) && overlap_along_axes(b, a)) {
    return {};
  }
  const Nearest of_b = nearest_corner(a, b);
  const Nearest of_a = nearest_corner(b, a);
  if (of_b.square <= of_a.square) {
    return {std::sqrt(of_b.square), of_b.foot, of_b.corner};
  }
  return {std::sqrt(of_a.square), of_a.corner, of_a.foot};
}

void check(const Footprint& footprint) {
  expects(footprint.length > 0.0 && std::isfinite(footprint.length), "length > 0");
  expects(footprint.shape == Shape::segment ||
              (footprint.width > 0.0 && std::isfinite(footprint.width)),
          "width > 0");
  expects(std::isfinite(footprint.centre_x), "centre_x is finite");
}

Body about(const Footprint& footprint, Vec2 centre, Turn turn) {
  const Vec2 half = half_axes(footprint);
  return {footprint.shape, half.x, half.y, centre, turn};
}

}  // namespace

std::string_view name(Shape shape) {
  return name_of(shape, shape_names);
}

std::optional<Shape> shape_from(std::string_view name) {
  return value_from<Shape>(name, shape_names);
}

Vec2 half_axes(const Footprint& footprint) {
  return {0.5 * footprint.length, footprint.shape == Shape::segment ? 0.0 : 0.5 * footprint.width};
}

Vec2 support(const Footprint& footprint, const Pose& X_WB, Vec2 direction_W) {
  check(footprint);
  expects(is_finite(X_WB), "X_WB is finite");
  expects(is_finite(direction_W) && dot(direction_W, direction_W) > 0.0, "direction is not zero");
  const Body body = about(footprint, {}, turn_by(X_WB.yaw));
  return X_WB.p + body.turn * Vec2{footprint.centre_x, 0.0} + farthest(body, direction_W);
}

double bounding_radius(const Footprint& footprint) {
  check(footprint);
  const auto [a, b] = half_axes(footprint);
  const double ahead = std::abs(footprint.centre_x);
  if (footprint.shape != Shape::ellipse) {
    return std::hypot(ahead + a, b);
  }
  // Squared distance of the point (ahead + a c, b sqrt(1 - c^2)): largest at an end of the long
  // axis, or, when the ellipse lies across, where its derivative over c vanishes.
  const double excess = b * b - a * a;
  if (ahead * a >= excess) {
    return ahead + a;
  }
  return std::sqrt(b * b + ahead * ahead * (1.0 + a * a / excess));
}

Separation separation(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB) {
  check(a);
  check(b);
  expects(is_finite(X_WA), "X_WA is finite");
  expects(is_finite(X_WB), "X_WB is finite");
  // About the first body's origin, so that digits are not lost far from the world's.
  const Turn turn_a = turn_by(X_WA.yaw);
  const Turn turn_b = turn_by(X_WB.yaw);
  const Body body_a = about(a, turn_a * Vec2{a.centre_x, 0.0}, turn_a);
  const Body body_b = about(b, (X_WB.p - X_WA.p) + turn_b * Vec2{b.centre_x, 0.0}, turn_b);
  const bool boxes = a.shape != Shape::ellipse && b.shape != Shape::ellipse;
  const Separation found = boxes ? between_boxes(body_a, body_b) : with_ellipse(body_a, body_b);
  return {found.distance, X_WA.p + found.p_a_W, X_WA.p + found.p_b_W};
}

}  // namespace saca::world

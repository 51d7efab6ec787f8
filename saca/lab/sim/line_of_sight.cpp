#include "saca/lab/sim/line_of_sight.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace saca::sim {
namespace {

constexpr double line_width = 1e-6;  // [m]: a sight line is a box that thin

struct SightLine {
  Vec2 from_W;
  Vec2 to_W;
};

/// Does a line pass a disc without touching it?
bool passes(const SightLine& line, Vec2 p_W, double radius) {
  const Vec2 along = line.to_W - line.from_W;
  const double square = dot(along, along);
  const double share = std::clamp(dot(p_W - line.from_W, along) / square, 0.0, 1.0);
  const Vec2 away = p_W - (line.from_W + share * along);
  return dot(away, away) > radius * radius;
}

bool blocks(const world::Actor& body, const SightLine& line) {
  if (passes(line, body.X_WA.p, world::bounding_radius(body.footprint) + line_width)) {
    return false;
  }
  const Vec2 along = line.to_W - line.from_W;
  const world::Footprint box{world::Shape::box, norm(along), line_width};
  const Pose X_WS{line.from_W + 0.5 * along, std::atan2(along.y, along.x)};
  return world::separation(box, X_WS, body.footprint, body.X_WA).distance <= 0.0;
}

/// A body's centre and its four corners, or a wall's ends, or the ends of an ellipse's axes.
std::array<Vec2, 5> points_of(const world::Actor& actor) {
  const world::Footprint& shape = actor.footprint;
  const auto [a, b] = world::half_axes(shape);
  const bool round = shape.shape == world::Shape::ellipse;
  std::array<Vec2, 5> points =
      round ? std::array<Vec2, 5>{Vec2{}, {a, 0.0}, {0.0, b}, {-a, 0.0}, {0.0, -b}}
            : std::array<Vec2, 5>{Vec2{}, {a, b}, {-a, b}, {-a, -b}, {a, -b}};
  for (Vec2& p : points) {
    p = actor.X_WA * (p + Vec2{shape.centre_x, 0.0});
  }
  return points;
}

}  // namespace

bool in_sight(const Pose& X_WB, const world::Footprint& ego, const world::Actor& actor,
              std::span<const world::Actor> bodies) {
  const Vec2 roof_W = X_WB * Vec2{ego.centre_x, 0.0};
  const Vec2 front_W = X_WB * Vec2{ego.centre_x + 0.5 * ego.length, 0.0};
  const auto is_free = [&](const SightLine& line) {
    return norm(line.to_W - line.from_W) < line_width ||
           std::none_of(bodies.begin(), bodies.end(), [&](const world::Actor& body) {
             const bool itself = body.kind == actor.kind && body.id == actor.id;
             return !itself && blocks(body, line);
           });
  };
  const std::array<Vec2, 5> points = points_of(actor);
  return std::any_of(points.begin(), points.end(), [&](Vec2 p_W) {
    return is_free({front_W, p_W}) || is_free({roof_W, p_W});
  });
}

}  // namespace saca::sim

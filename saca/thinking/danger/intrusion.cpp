#include "saca/thinking/danger/intrusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::danger {
namespace {

using world::Footprint;
using world::Shape;

/// Directions of a half circle that are looked at first.
constexpr int num_directions = 32;
constexpr double direction_step = std::numbers::pi / num_directions;

/// Two footprints that overlap, about their own centres.
struct Overlap {
  struct Body {
    bool is_round = false;
    Vec2 half;         ///< [m]
    double yaw = 0.0;  ///< [rad]

    /// Farthest reach from the centre along a direction [m].
    [[nodiscard]] double reach(double direction) const {
      const double along = half.x * std::cos(direction - yaw);
      const double across = half.y * std::sin(direction - yaw);
      return is_round ? std::sqrt(along * along + across * across)
                      : std::abs(along) + std::abs(across);
    }
  };
  Body a;
  Body b;
  Vec2 between;  ///< from the centre of a to the centre of b [m]

  /// The way along a direction, in its better sense, that parts the two [m].
  [[nodiscard]] double depth(double direction) const {
    const double already = between.x * std::cos(direction) + between.y * std::sin(direction);
    return a.reach(direction) + b.reach(direction) - std::abs(already);
  }
};

Overlap::Body body_of(const Footprint& footprint, const Pose& X_WB) {
  return {footprint.shape == Shape::ellipse, world::half_axes(footprint), X_WB.yaw};
}

Vec2 centre_of(const Footprint& footprint, const Pose& X_WB) {
  return X_WB * Vec2{footprint.centre_x, 0.0};
}

/// The least depth between two directions with at most one valley between them: golden section.
double valley(const Overlap& overlap, double low, double high) {
  constexpr double ratio = std::numbers::phi - 1.0;
  double left = high - ratio * (high - low);
  double right = low + ratio * (high - low);
  double at_left = overlap.depth(left);
  double at_right = overlap.depth(right);
  for (int i = 0; i < 24; ++i) {  // leaves 2e-6 rad: 1e-11 m where the depth is smooth
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - ratio * (high - low);
      at_left = overlap.depth(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + ratio * (high - low);
      at_right = overlap.depth(right);
    }
  }
  return std::min(at_left, at_right);
}

/// The footprints' Minkowski sum is a polygon: its boundary is nearest along a normal of its sides.
double least_depth_of_polygons(const Overlap& overlap) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  return std::min({overlap.depth(overlap.a.yaw), overlap.depth(overlap.a.yaw + quarter),
                   overlap.depth(overlap.b.yaw), overlap.depth(overlap.b.yaw + quarter)});
}

/// With an ellipse the depth is smooth between the normals of the box's sides, if there is a box.
/// Those are among the directions looked at, as they are multiples of the step from its yaw.
double least_depth(const Overlap& overlap) {
  const double first = overlap.a.is_round ? overlap.b.yaw : overlap.a.yaw;
  const auto direction = [&](int i) { return first + i * direction_step; };
  std::array<double, num_directions> depth{};
  for (int i = 0; i < num_directions; ++i) {
    depth[static_cast<std::size_t>(i)] = overlap.depth(direction(i));
  }
  const auto at = [&](int i) {  // a half turn gives the same
    return depth[static_cast<std::size_t>((i + num_directions) % num_directions)];
  };
  double least = *std::min_element(depth.begin(), depth.end());
  for (int i = 0; i < num_directions; ++i) {
    if (at(i) <= at(i - 1) && at(i) <= at(i + 1)) {
      least = std::min({least, valley(overlap, direction(i - 1), direction(i)),
                        valley(overlap, direction(i), direction(i + 1))});
    }
  }
  return least;
}

}  // namespace

double intrusion(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB) {
  const double distance = world::separation(a, X_WA, b, X_WB).distance;
  if (distance > 0.0) {
    return -distance;
  }
  const Overlap overlap{body_of(a, X_WA), body_of(b, X_WB),
                        centre_of(b, X_WB) - centre_of(a, X_WA)};
  const bool polygons = !overlap.a.is_round && !overlap.b.is_round;
  // Rounding may leave a trace below 0 where they only touch.
  return std::max(0.0, polygons ? least_depth_of_polygons(overlap) : least_depth(overlap));
}

double intrusion(const Footprint& footprint, const Pose& X_WB, const HalfPlane& ground) {
  expects(std::abs(norm(ground.normal_W) - 1.0) <= 1e-9, "normal_W has length 1");
  expects(std::isfinite(ground.offset), "offset is finite");
  const Vec2 p_W = world::support(footprint, X_WB, ground.normal_W);
  return dot(ground.normal_W, p_W) - ground.offset;
}

}  // namespace saca::danger

#include "saca/base/world/road.h"

#include <array>
#include <cmath>

#include "saca/base/core/names.h"

namespace saca::world {
namespace {

constexpr std::array<std::string_view, 4> beyond_names{"unmarked", "kerb", "barrier", "trees"};
constexpr std::array<std::string_view, 3> topology_names{"straight", "intersection", "one_way"};

/// sin(x) / x and (1 - cos(x)) / x, smooth through zero: a straight road is an arc too.
double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}
double cosc(double x) {
  return std::abs(x) < 1e-4 ? x / 2.0 : (1.0 - std::cos(x)) / x;
}

}  // namespace

std::string_view name(Beyond beyond) {
  return name_of(beyond, beyond_names);
}
std::string_view name(Topology topology) {
  return name_of(topology, topology_names);
}
std::optional<Beyond> beyond_from(std::string_view name) {
  return value_from<Beyond>(name, beyond_names);
}
std::optional<Topology> topology_from(std::string_view name) {
  return value_from<Topology>(name, topology_names);
}

LanePose to_lane(const Road& road, const Pose& X_WB) {
  const Vec2 p = rotated(X_WB.p - road.X_WL.p, -road.X_WL.yaw);
  const double k = road.curvature;
  if (k == 0.0) {
    return {p.x, p.y, wrap_angle(X_WB.yaw - road.X_WL.yaw)};
  }
  // The centre of the arc lies at (0, 1/k). With the angle `turned` about it, s = turned / k; the
  // forms below have no 1/k, so they hold on a straight road.
  const double turned = std::atan2(k * p.x, 1.0 - k * p.y);
  const double s =
      std::abs(k * p.x) < 1e-9 && 1.0 - k * p.y > 0.0 ? p.x / (1.0 - k * p.y) : turned / k;
  // With r = |1 - k * (x, y)|: d = (1 - r) / k = (2 y - k (x^2 + y^2)) / (1 + r).
  const double r = norm({k * p.x, 1.0 - k * p.y});
  const double d = (2.0 * p.y - k * dot(p, p)) / (1.0 + r);
  return {s, d, wrap_angle(X_WB.yaw - road.X_WL.yaw - turned)};
}

Pose from_lane(const Road& road, const LanePose& pose) {
  if (road.curvature == 0.0) {
    return road.X_WL * Pose{{pose.s, pose.d}, wrap_angle(pose.heading)};
  }
  const double turned = road.curvature * pose.s;
  const Vec2 centre{pose.s * sinc(turned), pose.s * cosc(turned)};
  const Pose X_LC{centre, turned};
  return road.X_WL * Pose{X_LC * Vec2{0.0, pose.d}, wrap_angle(turned + pose.heading)};
}

}  // namespace saca::world

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "saca/base/core/pose.h"

namespace saca::world {

/// What stands beyond an edge of the road: whoever leaves the road meets it.
enum class Beyond : std::uint8_t {
  unmarked,  ///< open ground; the stated default where a source says nothing
  kerb,
  barrier,
  trees,
};

/// Does it stop a car at once: a barrier, or trees?
constexpr bool is_hard(Beyond beyond) {
  return beyond == Beyond::barrier || beyond == Beyond::trees;
}

enum class Topology : std::uint8_t { straight, intersection, one_way };

[[nodiscard]] std::string_view name(Beyond beyond);
[[nodiscard]] std::string_view name(Topology topology);
[[nodiscard]] std::optional<Beyond> beyond_from(std::string_view name);
[[nodiscard]] std::optional<Topology> topology_from(std::string_view name);

/// The road near the ego: its own lane as an arc of constant curvature, and how far the ground
/// reaches to either side of that lane's centre line.
struct Road {
  Topology topology = Topology::straight;
  Pose X_WL;                  ///< a point on the centre of the ego's lane, x along the lane
  double curvature = 0.0;     ///< of the centre line, > 0 turns left [1/m]
  double lane_width = 3.5;    ///< [m], > 0
  double left_edge = 1.75;    ///< d of the left edge [m], > 0
  double right_edge = -1.75;  ///< d of the right edge [m], < 0
  Beyond left_beyond = Beyond::unmarked;
  Beyond right_beyond = Beyond::unmarked;
  bool oncoming_left = false;   ///< the lane to the left belongs to oncoming traffic
  bool oncoming_right = false;  ///< likewise to the right

  bool operator==(const Road&) const = default;
};

/// A pose along the road: s [m] from X_WL along the centre line, d [m] to the left of it, heading
/// [rad] against the lane's direction there.
struct LanePose {
  double s = 0.0;
  double d = 0.0;
  double heading = 0.0;
};

/// @return  unique within |d| < 1 / |curvature|
[[nodiscard]] LanePose to_lane(const Road& road, const Pose& X_WB);
[[nodiscard]] Pose from_lane(const Road& road, const LanePose& pose);

}  // namespace saca::world

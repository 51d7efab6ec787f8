#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::atlas {

/// What of an atlas stops is followed so long at most [s].
constexpr double longest_stop = 120.0;

/// Where on an atlas' grid.
struct AtlasPoint {
  AtlasKind kind = AtlasKind::stop;
  double speed = 0.0;  ///< [m/s]
  double grip = 0.0;   ///< [-]
  double way = 0.0;    ///< to the side [m]
  double share = 0.0;  ///< of the speed or of the grip [-]
};
/// @param number  < num_nodes(grid)
[[nodiscard]] AtlasPoint point_of(const AtlasGrid& grid, std::size_t number);

/// To the left where it goes to a side.
[[nodiscard]] manoeuvre::Plan plan_of(const AtlasPoint& point);

/// Straight along the lane; a way that no lane is wide enough for begins beside the middle.
[[nodiscard]] world::Scene scene_of(const manoeuvre::Car& car, const AtlasPoint& point);

/// The car as it is driven for an atlas: just beyond its domain too, so that every cell which
/// touches that has corners.
[[nodiscard]] manoeuvre::Car unbounded(manoeuvre::Car car);

/// A drive as it was: six numbers every `step`, of the lane's frame at the start.
struct AtlasTrace {
  double step = 0.01;                       ///< [s]
  std::vector<std::array<double, 6>> look;  ///< x, y [m], heading [rad], and their rates
  double end = 0.0;                         ///< [s]
  bool ended = false;
};
/// @param longest  what comes later is left out, and the drive has then not ended [s]
[[nodiscard]] AtlasTrace trace_of(const manoeuvre::EgoMotion& motion, double longest);

}  // namespace saca::atlas

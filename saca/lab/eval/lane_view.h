#pragma once

#include <optional>

#include "saca/base/world/scene.h"

namespace saca::eval {

/// One road user as rules see it that know lanes only: along the ego's lane and across it.
struct LaneView {
  double gap = 0.0;            ///< from bumper to bumper along the lane; <= 0: abreast [m]
  double side_gap = 0.0;       ///< from side to side across it; <= 0: in the ego's path [m]
  double speed = 0.0;          ///< along the lane; < 0: it comes towards the ego [m/s]
  double closing_aside = 0.0;  ///< how fast it comes nearer across the lane [m/s]
  double ego_speed = 0.0;      ///< along the lane [m/s]
  double ego_aside = 0.0;      ///< of the ego, how fast it comes nearer to the other [m/s]
  bool ahead = false;          ///< its centre is ahead of the ego's
  bool left = false;           ///< its centre is to the left of the ego's
};

/// The body's extent along and across the lane is that of its box as it stands there.
[[nodiscard]] LaneView lane_view(const world::Scene& scene, const world::Actor& actor);

/// Seconds to contact along the lane if both keep their speeds; nullopt: they do not close, or
/// their paths do not overlap.
[[nodiscard]] std::optional<double> time_to_collision(const LaneView& view);

}  // namespace saca::eval

#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "saca/base/core/pose.h"
#include "saca/base/world/footprint.h"
#include "saca/base/world/road.h"
#include "saca/base/world/track.h"

namespace saca::collision {

enum class Side : std::uint8_t { left, right };

/// How far a footprint stays inside one edge of the road [m]; negative: it reaches beyond by as
/// much.
///
/// Exact for boxes and ellipses on straight roads and on arcs, up to 1e-6 m.
/// @throws ContractViolation  if the edges do not lie to either side of the lane's centre
[[nodiscard]] double edge_clearance(const world::Road& road, Side side,
                                    const world::Footprint& footprint, const Pose& X_WB);

struct EdgeApproach {
  std::optional<double> crossing;  ///< when any point of the footprint first lies on the edge
  double clearance = 0.0;          ///< smallest until then, at most `of_interest` [m]
  double nearest_at = 0.0;         ///< when it is, if it is less than `of_interest` [s]
};

/// When a body that follows `track` first leaves the road to one side; at once when it stands
/// beyond the edge already. Exact to 1 mm for samples every 10 ms.
/// @param from  where to begin to look, if after the track's start [s]
[[nodiscard]] EdgeApproach edge_approach(const world::Road& road, Side side,
                                         const world::Footprint& footprint,
                                         const world::Track& track, double of_interest,
                                         double from = -std::numeric_limits<double>::infinity());

/// The footprint's point that reaches farthest to one side of the road.
[[nodiscard]] Vec2 outermost(const world::Road& road, Side side, const world::Footprint& footprint,
                             const Pose& X_WB);

}  // namespace saca::collision

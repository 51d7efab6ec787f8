#pragma once

#include "saca/base/core/pose.h"
#include "saca/base/world/footprint.h"

namespace saca::danger {

/// How deep a footprint stands in another: the shortest way by which one must be shifted until they
/// only touch; less than 0 when they are apart: minus the distance [m].
///
/// Exact to 1e-6 m; allocates nothing. Symmetric in the two; for a fixed course its slope over the
/// position is 1 wherever it has one.
/// @throws ContractViolation  if a size is not > 0 or a pose is not finite
[[nodiscard]] double intrusion(const world::Footprint& a, const Pose& X_WA,
                               const world::Footprint& b, const Pose& X_WB);

/// The ground beyond a straight edge: all p_W with dot(normal_W, p_W) >= offset.
struct HalfPlane {
  Vec2 normal_W{0.0, 1.0};  ///< of length 1, into the half plane
  double offset = 0.0;      ///< of the edge from the origin, along the normal [m]
};

/// How far a footprint reaches beyond the edge; less than 0: minus the distance from it [m].
/// @throws ContractViolation  if a size is not > 0, a number is not finite, or the normal's length
///                            is not 1 (to 1e-9)
[[nodiscard]] double intrusion(const world::Footprint& footprint, const Pose& X_WB,
                               const HalfPlane& ground);

}  // namespace saca::danger

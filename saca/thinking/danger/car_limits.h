#pragma once

#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/avoidance.h"

namespace saca::danger {

/// Limits of a car as the avoidance problem has them, on `grip`.
///
/// Curvature: that of the centre of mass with the wheels turned to their limit and no slip. Drive:
/// what the driven axles can bring to the ground at rest's loads, or the motor if that is less; a
/// motor that limits at this grip limits on less grip as well, though it need not: there the
/// problem is a little too careful.
/// @param grip  [-], > 0
[[nodiscard]] Avoidance avoidance_of(const vehicle::Vehicle& car, double grip);

}  // namespace saca::danger

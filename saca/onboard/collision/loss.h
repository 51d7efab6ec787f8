#pragma once

#include "saca/onboard/collision/face.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::collision {

// The paper's two losses (arXiv 2504.00115, section V-B), for its tables. Harm decides, not these.

/// Relative speed at first contact times the injury rate of the ego's face: 0.41 side, 0.35 front,
/// 0.21 rear.
/// @param relative_speed  [m/s], >= 0
[[nodiscard]] double collision_loss(Face ego_face, double relative_speed);

/// Cost of a manoeuvre where there was no risk: 0.5 for policies 0 to 4, 1.0 for 5 and 6, 0 for 7.
[[nodiscard]] double false_trigger_loss(manoeuvre::PolicyId policy);

}  // namespace saca::collision

#pragma once

#include "saca/manoeuvre/drive.h"
#include "saca/outcome/impact.h"
#include "saca/world/footprint.h"

namespace saca::outcome {

/// A body after a blow, all wheels at the limit of friction, until it rests.
///
/// @param body            mass, inertia and motion just after the blow, about its origin
/// @param X_WB, start     where it is then, and when; body.p_W is not used
/// @param grip            friction coefficient of the road [-], > 0
/// @param steps_per_pose  of the integration, >= 1; tests ask for more
/// @return                poses every 10 ms from `start` to rest, `ended`; one pose for a body that
///                        nothing moves
/// @throws ContractViolation  if the motion is not finite or a number out of range
///
/// Each of four wheels is a point that grip * load pulls against its own velocity, so a body that
/// spins slides farther. That everybody brakes so after a blow, drivers and people on the ground
/// alike, is an ASSUMPTION; so is where the wheels are: 0.3 of the length ahead of and behind the
/// footprint's centre, 0.4 of the width beside it. Loads are those at rest. Below 0.05 m/s a
/// wheel's force fades in proportion, and a body all of whose wheels are slower rests. Runge-Kutta,
/// fourth order, every 5 ms.
[[nodiscard]] manoeuvre::EgoMotion slide(const world::Footprint& footprint, const ImpactBody& body,
                                         const Pose& X_WB, double start, double grip,
                                         int steps_per_pose = 2);

}  // namespace saca::outcome

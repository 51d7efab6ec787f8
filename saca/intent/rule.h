#pragma once

#include "saca/intent/intention.h"
#include "saca/world/scene.h"

namespace saca::intent {

/// What a vehicle intends, from what is measured now: deceleration along its course, and its
/// lateral speed across the lane (of one that crosses the lane: the turn of its own course).
///
/// P(brakes) rises from 3 % (10 % for those who cross: they may give way) to 95 % about 2 m/s^2 of
/// deceleration; P(moves left), P(moves right) rise from 2 % to 90 % about 0.5 m/s of lateral
/// speed; the two are taken as independent. All are assumptions, but for 2 m/s^2, the project's own
/// mark of braking. Obstacles and who is at rest maintain.
/// @throws ContractViolation  for a pedestrian or a cyclist
[[nodiscard]] IntentPosterior vehicle_posterior(const world::Scene& scene,
                                                const world::Actor& actor);

}  // namespace saca::intent

#pragma once

#include "saca/base/world/footprint.h"
#include "saca/onboard/collision/collision_impulse.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::rollout {

/// How finely a slide is worked out.
struct SlideSteps {
  double pose = 0.01;  ///< between poses [s], in (0, 0.05]
  int per_pose = 2;    ///< of the integration, >= 1; more while a body spins fast
};
/// For forecasts: positions to half a decimetre, in an eighth of the time.
constexpr SlideSteps coarse_slide{.pose = 0.04, .per_pose = 1};

/// A body after an impact, all wheels at the limit of friction, until it rests.
///
/// @param body            mass, inertia and motion just after the impact, about its origin
/// @param X_WB, start     where it is then, and when; body.p_W is not used
/// @param grip            friction coefficient of the road [-], > 0
/// @return                poses from `start` to rest, `ended`; one pose for a body that nothing
///                        moves
/// @throws ContractViolation  if the motion is not finite or a number out of range
///
/// Each of four wheels is a point that grip * load pulls against its own velocity, so a body that
/// spins slides farther. That everybody brakes so after an impact, drivers and people on the ground
/// alike, is an ASSUMPTION; so is where the wheels are: 0.3 of the length ahead of and behind the
/// footprint's centre, 0.4 of the width beside it. Loads are those at rest. Below 0.05 m/s, or what
/// 10 m/s^2 take in a longer step, a wheel's force fades in proportion, and a body all of whose
/// wheels are slower rests. Runge-Kutta, fourth order.
[[nodiscard]] manoeuvre::EgoMotion slide(const world::Footprint& footprint,
                                         const collision::ImpactBody& body, const Pose& X_WB,
                                         double start, double grip, const SlideSteps& steps = {});

}  // namespace saca::rollout

#pragma once

#include "saca/base/world/scene.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/intent/motion.h"

namespace saca::intent {

/// What a pedestrian or a cyclist intends, from what is measured now. A model that is stated, not
/// learned: recordings of traffic have none of them.
///
/// P(stop) rises from 3 % (10 % for those who cross the road: they may wait) to 95 % about the
/// deceleration that is past doubt; who is at rest has stopped. Of the rest, P(cross) is a logistic
/// of the distance to the road [m], from where it is stepped on, and the speed towards the ego's
/// lane [m/s]. Who stands at the road's edge starts with 8 %; who goes along it turns with 3 %, on
/// a bicycle with 1 %. All are assumptions, made so that a walk of 1.4 m/s towards the lane from
/// the edge is most likely a crossing, and nobody who is far away or turned away is thought to.
/// @throws ContractViolation  for other road users
[[nodiscard]] IntentPosterior vru_posterior(const world::Scene& scene, const world::Actor& actor);

/// The same `ahead` seconds later, if it goes on as it does.
[[nodiscard]] IntentPosterior vru_posterior(const world::Scene& scene, const world::Actor& actor,
                                            double ahead);

/// A pedestrian or cyclist turns to the ego's lane, or starts towards it, and crosses it at right
/// angles, at its speed or at `walking_speed` if it is slower; who is between the lane's edges goes
/// on to the side it moves to. Its course turns with `turning`.
/// @throws ContractViolation  for other road users, horizon <= 0
/// @return  as `motion_under`
[[nodiscard]] Forecast crossing_motion(const world::Scene& scene, const world::Actor& actor,
                                       double horizon, const MotionLaw& law);

}  // namespace saca::intent

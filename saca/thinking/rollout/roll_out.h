#pragma once

#include <span>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/rollout/collision_sequence.h"

namespace saca::rollout {

/// What happens if `plan` is carried out in this scene: full dynamics to rest or a recovered lane,
/// or, when neither comes, for 20 s, and longer where even a stop takes longer. The reference, one
/// at a time: `drive`, then `collision_sequence`.
/// @param grip  true friction coefficient
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
[[nodiscard]] collision::Outcome roll_out(const manoeuvre::Car& car, const manoeuvre::Plan& plan,
                                          const world::Scene& scene,
                                          std::span<const world::Track> tracks, double grip,
                                          const collision::HarmModel& harm);

/// One plan to be tried, of many. What it points to is not null and outlives the call.
struct Attempt {
  manoeuvre::Plan plan;
  const world::Scene* scene = nullptr;
  const collision::Others* others = nullptr;      ///< may be called by several threads at once
  double grip = 0.0;                              ///< true friction coefficient
  manoeuvre::ParameterPerturbation perturbation;  ///< what else the controller does not know; its
                                                  ///< grip is a factor of `grip`
};

/// What comes of each, driven side by side by the batch (rollout/batch.h): as `roll_out`, but the
/// ego's way may be centimetres off, and takes a fiftieth of the time or less. One does not depend
/// on the others.
/// @param threads  >= 1; they do not change the result
/// @return         in the order of `attempts`
/// @throws ContractViolation  as roll_out
[[nodiscard]] std::vector<CollisionSequence> roll_out_all(const manoeuvre::Car& car,
                                                          std::span<const Attempt> attempts,
                                                          const collision::HarmModel& harm,
                                                          int threads = 1);

}  // namespace saca::rollout

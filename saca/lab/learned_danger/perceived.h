#pragma once

#include "saca/base/core/pose.h"
#include "saca/base/world/scene.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/thinking/danger/danger.h"

/// What is perceived of a scene as V_h has it.
namespace saca::learned_danger {

/// The ego: steering, brakes and motor are taken for those that its motion needs.
[[nodiscard]] Ego perceived_ego(const manoeuvre::Car& car, const world::EgoState& ego);

/// Whom the ego meets: of a body that is no box the box around it.
/// @param X_WO  where it is, pointing where it moves
[[nodiscard]] Obstacle perceived_obstacle(const danger::Meeting& meeting,
                                          const danger::Motion& motion, const Pose& X_WO);

/// The scene's ego, and of its actors those whose V_h is highest, each by itself: three at most. Of
/// those who are told to be equally far (net_inputs.h), the nearest.
[[nodiscard]] State most_dangerous(const Network& network, const manoeuvre::Car& car,
                                   const world::Scene& scene);

}  // namespace saca::learned_danger

#pragma once

#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/intent/side_moves.h"

namespace saca::intent {

/// One way in which a road user may move on: under an intention, or, where it moves to the side
/// already, going on with that until it ends somewhere.
struct LikelyMotion {
  double probability = 0.0;
  Intention intention = Intention::maintain;
  std::optional<SideMove> aside;  ///< beside it, where it maintains or brakes; nullopt: as the law
                                  ///< has the intention
  bool hard = false;              ///< where it brakes: as in an emergency
};

/// Of vehicles that brake, the share that does it as in an emergency, by 6 m/s^2 or what is
/// measured, if that is more, reached within 0.5 s [-]. Fitted (docs/forecast.md).
constexpr double hard_braking_share = 0.3;

/// Of a vehicle that surely moves to the side, the share that ends it anywhere [-]: fitted.
constexpr double side_move_share = 0.85;

/// Likewise of a cyclist who rides along a lane: who moves across it swerves and rides on, or
/// crosses the road, as likely either way. An assumption: no recording here has cyclists.
constexpr double cyclist_side_move_share = 0.5;

/// Its intentions alone. Their probabilities sum to 1.
[[nodiscard]] std::vector<LikelyMotion> intended_motions(const Belief& belief);

/// All that are likely by what is believed of it now; those that go on with a move to the side end
/// soonest first. Their probabilities sum to 1.
[[nodiscard]] std::vector<LikelyMotion> likely_motions(const world::Scene& scene,
                                                       const world::Actor& actor,
                                                       const Belief& belief,
                                                       const SideMoveLaw& law = {});

/// As motion_under, of any of them.
[[nodiscard]] Forecast forecast_of(const LikelyMotion& motion, const world::Scene& scene,
                                   const world::Actor& actor, double horizon, const MotionLaw& law);

}  // namespace saca::intent

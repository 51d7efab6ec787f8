#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/forecast/plans.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/danger/danger.h"
#include "saca/thinking/intent/cue_law.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/preview/caution.h"
#include "saca/thinking/preview/situation.h"
#include "saca/thinking/rollout/collision_sequence.h"
#include "saca/thinking/rollout/roll_out.h"

namespace saca::preview {

/// What futures are forecast with. What it points to outlives the forecasts.
struct ForecastTools {
  const manoeuvre::Car* car = nullptr;          ///< not null
  const collision::HarmModel* harm = nullptr;   ///< likewise
  const atlas::Atlas* atlas = nullptr;          ///< of this car; nullptr: everything is rolled out
  const danger::DangerModel* danger = nullptr;  ///< of this car; nullptr: the best of few evasions
  intent::MotionLaw motion = hard_driving();    ///< how the others move under an intention
  forecast::Braking braking = forecast::Braking::any_strength;  ///< which plans there are
  const intent::CueLaw* cues = nullptr;  ///< what cues of a scene stand for; nullptr: nothing
};

/// What each policy ends in when it begins in `scene` and the actors follow their tracks, those
/// behind the ego but react to it: see with_reacting_followers. 3 and 4 brake to whichever of
/// forecast::target_shares of the speed is best, 0 by whichever strength is; of equals the hardest.
///
/// Read from the atlas: a tenth of a millisecond, and where somebody follows some milliseconds.
/// What is not known of the others' places then counts in harm and probability. Where the atlas has
/// not all that can be driven, all of it is rolled out, in tens of milliseconds: the atlas counts a
/// first contact only, so figures of the two are not compared.
/// @param spreads  about the tracks, one per actor, those who react included; or none at all: as
///                 perceived in `scene`, of who reacts the place alone
[[nodiscard]] AllFacts policy_facts(const world::Scene& scene,
                                    const std::vector<world::Track>& tracks,
                                    const ForecastTools& tools,
                                    const std::vector<world::SpreadOverTime>& spreads = {});

/// What the atlas says that these plans end in; followers react as in policy_facts.
/// @return  in the order of `plans`; nullopt: there is no atlas, or it lacks one that can be driven
[[nodiscard]] std::optional<std::vector<PolicyFacts>> read_plans(
    const world::Scene& scene, const std::vector<world::Track>& tracks,
    std::span<const manoeuvre::Plan> plans, const ForecastTools& tools);

/// What one plan led to with full dynamics.
struct RolledOut {
  PolicyFacts facts;
  rollout::CollisionSequence sequence;  ///< to its end; empty when refused
};
/// rollout::roll_out_all of those attempts that can be driven; the others are refused.
/// @return  in the order of `attempts`
[[nodiscard]] std::vector<RolledOut> tried(const manoeuvre::Car& car,
                                           std::span<const rollout::Attempt> attempts,
                                           const collision::HarmModel& harm, int threads = 1);

/// What these plans end in, with full dynamics, whatever the atlas says: for the rollout check.
[[nodiscard]] std::vector<PolicyFacts> rolled_out(const world::Scene& scene,
                                                  const std::vector<world::Track>& tracks,
                                                  std::span<const manoeuvre::Plan> plans,
                                                  const ForecastTools& tools);

/// The policy whose forecast is best by the one ordering; ties go to the milder.
[[nodiscard]] manoeuvre::PolicyId best_by_forecast(const AllFacts& facts);

}  // namespace saca::preview

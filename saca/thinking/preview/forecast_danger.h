#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/danger/risk.h"
#include "saca/thinking/preview/forecast_facts.h"
#include "saca/thinking/preview/plan_facts.h"

namespace saca::preview {

/// How long a policy is driven before whatever evades best from there on [s]: as long as an input
/// of Q_h learnt is held (learned_danger::keep_held). What less leads to hardly differs.
constexpr double committed = 0.5;

/// V_h [m] beside the actors of a scene, of whom there is one or more.
using DangerOfScene = std::function<double(const world::Scene&)>;

/// Q_h of a plan (eq. 2): it is driven for `committed` seconds with full dynamics, and then
/// whatever evades best. How deep that still runs into those who are ahead now, or the plan has run
/// by then [m]; less than 0: minus the room that is left.
/// @param tracks  one per actor
/// @param value   asked once, of the scene as it is then, with those who were ahead
/// @return  nullopt: nobody is ahead
/// @throws ContractViolation  if tracks and actors differ in number, or somebody is ahead and the
///                            plan cannot be driven
[[nodiscard]] std::optional<double> plan_danger(const world::Scene& scene,
                                                const std::vector<world::Track>& tracks,
                                                const manoeuvre::Plan& plan,
                                                const manoeuvre::Car& car,
                                                const DangerOfScene& value);

/// plan_danger of each policy: whom it runs into on the way, and then the highest V_h of the three
/// who are most dangerous in the scene, each by itself. More of them would cost milliseconds each.
/// @param risks  one per actor of the scene
/// @param facts  of the same scene: whose plans are driven
/// @param tools  with car and danger
/// @throws ContractViolation  if car or danger are missing, or tracks or risks differ from the
///                            actors in number
[[nodiscard]] PolicyDangers policy_dangers(const world::Scene& scene,
                                           const std::vector<world::Track>& tracks,
                                           const std::vector<danger::ObstacleRisk>& risks,
                                           const AllFacts& facts, const ForecastTools& tools);

}  // namespace saca::preview

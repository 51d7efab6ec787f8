#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::encounter {

/// One instant at which policies begin, and all that their outcome depends on.
struct DecisionPoint {
  world::Scene scene;        ///< the truth but for `grip`, which is what the ego believes in
  collision::Others others;  ///< what the others truly do from then on, the ego's motion given;
                             ///< may be called by several threads at once
  double grip = 0.0;         ///< true friction coefficient; `perturbation` may change it
  manoeuvre::ParameterPerturbation perturbation;  ///< what else the ego's controller does not know
  std::optional<manoeuvre::Plan> carried_out;     ///< tried instead of its policy's default plan
};

/// What one policy would have led to, knowing what the others really did.
using Hindsight = preview::RolledOut;
using Hindsights = std::array<Hindsight, manoeuvre::num_policies>;  ///< by PolicyId

/// All eight policies, begun at each moment, on the true grip: preview::tried. One moment does not
/// depend on the others.
/// @param threads  >= 1; they do not change the result
[[nodiscard]] std::vector<Hindsights> hindsights(std::span<const DecisionPoint> points,
                                                 const manoeuvre::Car& car,
                                                 const collision::HarmModel& harm, int threads = 1);
[[nodiscard]] Hindsights hindsight(const DecisionPoint& point, const manoeuvre::Car& car,
                                   const collision::HarmModel& harm);

/// Likewise every plan that can be chosen (forecast::all_plans), and what was carried out in the
/// place of its policy's default plan: it stands first among those of its policy.
/// @return  for each moment, in the order of forecast::all_plans of its ego's speed
[[nodiscard]] std::vector<std::vector<Hindsight>> all_plans_tried(
    std::span<const DecisionPoint> points, const manoeuvre::Car& car,
    const collision::HarmModel& harm, forecast::Braking braking = forecast::Braking::any_strength,
    int threads = 1);

/// Of each policy the plan that would have harmed least, of all target speeds; of those in one
/// class of harm (collision::harm_class) the first: what was carried out, else the default. Policy
/// 0 stands for what was carried out, else for full braking: that is what people compare with.
[[nodiscard]] Hindsights hindsight_of_all_speeds(const DecisionPoint& point,
                                                 const manoeuvre::Car& car,
                                                 const collision::HarmModel& harm);

}  // namespace saca::encounter

#include "saca/decide/check.h"

#include <array>
#include <span>

#include "saca/outcome/ordering.h"
#include "saca/reason/prompt.h"

namespace saca::decide {

using manoeuvre::PolicyId;

Check check(const preview::PolicyFacts& plan, const preview::PolicyFacts& aeb,
            const world::Scene& scene) {
  const std::string line = reason::policy_line(plan, scene);
  if (!plan.refusal.empty()) {
    return {false, line};
  }
  const PolicyId policy = plan.plan.policy;
  if (policy != PolicyId::aeb &&
      outcome::better(aeb.outcome, PolicyId::aeb, plan.outcome, policy)) {
    return {false, line + "; braking does no more harm: " + reason::policy_line(aeb, scene)};
  }
  return {true, line};
}

Check check(const manoeuvre::Plan& plan, const preview::Situation& situation,
            const preview::ForecastTools& tools) {
  const std::array plans{plan, manoeuvre::Plan{PolicyId::aeb, std::nullopt}};
  const std::size_t needed = plan.policy == PolicyId::aeb ? 1 : 2;
  const world::Scene& scene = situation.scene_at_trigger;
  const auto facts = rolled_out(scene, situation.tracks, std::span(plans).first(needed), tools);
  return check(facts.front(), facts.back(), scene);
}

Check check_unfounded(PolicyId chosen, const preview::Situation& situation) {
  const world::Scene& scene = situation.scene_at_trigger;
  const PolicyId best = preview::best_by_forecast(situation.facts);
  const std::string line = reason::policy_line(situation.facts[manoeuvre::index(chosen)], scene);
  if (chosen == best) {
    return {true, line + "; the reasons are false, yet nothing is forecast better"};
  }
  return {false, line + "; the reasons are false, and better is forecast: " +
                     reason::policy_line(situation.facts[manoeuvre::index(best)], scene)};
}

}  // namespace saca::decide

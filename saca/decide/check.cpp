#include "saca/decide/check.h"

#include <string_view>

#include "saca/outcome/ordering.h"
#include "saca/reason/prompt.h"

namespace saca::decide {

Check check(manoeuvre::PolicyId chosen, const preview::Situation& situation) {
  const preview::PolicyFacts& fact = situation.facts[manoeuvre::index(chosen)];
  const preview::PolicyFacts& aeb = situation.facts[manoeuvre::index(manoeuvre::PolicyId::aeb)];
  const world::Scene& scene = situation.scene_at_trigger;
  const std::string line = reason::policy_line(fact, scene);
  if (!fact.refusal.empty()) {
    return {false, line};
  }
  if (chosen != manoeuvre::PolicyId::aeb &&
      outcome::better(aeb.outcome, aeb.plan.policy, fact.outcome, chosen)) {
    return {false, line + "; braking does no more harm: " + reason::policy_line(aeb, scene)};
  }
  return {true, line};
}

}  // namespace saca::decide

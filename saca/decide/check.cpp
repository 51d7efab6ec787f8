#include "saca/decide/check.h"

#include <string_view>

#include "saca/outcome/outcome.h"
#include "saca/reason/prompt.h"

namespace saca::decide {

Check check(manoeuvre::PolicyId chosen, const preview::Situation& situation) {
  const preview::PolicyFacts& fact = situation.facts[manoeuvre::index(chosen)];
  const preview::PolicyFacts& aeb = situation.facts[manoeuvre::index(manoeuvre::PolicyId::aeb)];
  const world::Scene& scene = situation.scene_at_trigger;
  const std::string line = reason::policy_line(fact, scene);
  if (fact.refusal) {
    return {false, line};
  }
  if (chosen != manoeuvre::PolicyId::aeb &&
      outcome::strictly_less_harm(aeb.outcome, fact.outcome)) {
    return {false, line + "; worse than " + reason::policy_line(aeb, scene)};
  }
  return {true, line};
}

}  // namespace saca::decide

#include "saca/lab/encounter/saca_method.h"

#include "saca/lab/encounter/learnt_case.h"

namespace saca::encounter {

std::optional<Action> SacaMethod::step(const View& view) {
  const std::size_t num_encounters = avoider_.num_encounters();
  const Answer answer = avoider_.step(view.scene, from_seconds(view.scene.time));
  if (first_ && !thinking_ && avoider_.num_encounters() > num_encounters) {
    thinking_ = thinking();  // it is forgotten in the next step
  }
  if (!answer.begins) {
    return std::nullopt;
  }
  Action action{.plan = answer.plan.value_or(manoeuvre::doing_nothing)};
  if (answer.switched) {
    action.source = "supervisor";
    action.reason = name(answer.switched->reason);
    return action;
  }
  const reflex::Decision& decision = *avoider_.decision();
  if (!first_) {
    first_ = decision;
    followed_ = followed_case(decision, avoider_.planes().previews());
  }
  action.source = name(decision.source);
  action.reason = reason_of(decision, avoider_.planes().previews());
  return action;
}

std::optional<ThinkingFigures> SacaMethod::thinking() const {
  return thinking_ ? thinking_ : thinking_figures(avoider_.planes().previews(), first_);
}

}  // namespace saca::encounter

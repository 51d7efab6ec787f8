#include "saca/loop/saca_method.h"

namespace saca::loop {

std::optional<Action> SacaMethod::step(const View& view) {
  if (!view.driven) {
    planes_.watch(view.scene, view.beliefs);
    return std::nullopt;
  }
  const decide::Reflex reflex =
      planes_.step(view.scene, view.beliefs, from_seconds(view.scene.time), view.finished);
  if (reflex.switched) {
    return Action{.plan = reflex.switched->plan,
                  .source = "supervisor",
                  .reason = std::string(name(reflex.switched->reason))};
  }
  if (!reflex.triggered) {
    return std::nullopt;
  }
  const decide::Decision& decision = *planes_.decision();
  return Action{.plan = decision.plan,
                .source = std::string(name(decision.source)),
                .reason = reason_of(decision, planes_.previews())};
}

std::optional<ThinkingFigures> SacaMethod::thinking() const {
  return thinking_figures(planes_.previews(), planes_.decision());
}

}  // namespace saca::loop

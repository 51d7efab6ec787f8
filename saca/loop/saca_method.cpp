#include "saca/loop/saca_method.h"

namespace saca::loop {
namespace {

/// Why, without numbers, so that equal reasons can be counted.
std::string reason_of(const decide::Decision& decision) {
  if (decision.source != decide::Source::fallback) {
    return "a cached plan matches";
  }
  return !decision.similarity       ? "no plan is cached"
         : decision.gave_way_to_aeb ? "the plan that matches harms more than braking"
                                    : "no cached plan matches above 90 %";
}

}  // namespace

std::optional<Action> SacaMethod::step(const View& view) {
  if (!view.driven) {
    return std::nullopt;
  }
  const decide::Reflex reflex =
      planes_.step(view.scene, view.beliefs, from_seconds(view.scene.time));
  if (!reflex.triggered) {
    return std::nullopt;
  }
  const decide::Decision& decision = *planes_.decision();
  return Action{.plan = decision.plan,
                .source = std::string(name(decision.source)),
                .reason = reason_of(decision)};
}

}  // namespace saca::loop

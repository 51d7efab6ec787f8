#include "saca/runtime/charged_forecasts.h"

#include <algorithm>

namespace saca::runtime {

void ChargedForecasts::offer(const world::Scene& scene, const intent::Beliefs& beliefs,
                             const std::optional<decide::UnderWay>& under_way) {
  constexpr double rounding = 1e-9;  // [s]
  if (scene.time < free_at_ - rounding) {
    return;
  }
  free_at_ = scene.time + std::max(verdict_period, cost_);
  rounds_.push_back({scene, beliefs, under_way});
  while (rounds_.size() > 1 && is_ready(rounds_[1], scene.time)) {
    rounds_.pop_front();
  }
}

std::optional<decide::Verdict> ChargedForecasts::take(double now) {
  std::optional<Round> newest;
  while (!rounds_.empty() && is_ready(rounds_.front(), now)) {
    newest = rounds_.front();
    rounds_.pop_front();
  }
  return newest ? std::optional(judge_(newest->scene, newest->beliefs, newest->under_way))
                : std::nullopt;
}

}  // namespace saca::runtime

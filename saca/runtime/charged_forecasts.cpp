#include "saca/runtime/charged_forecasts.h"

#include <algorithm>

namespace saca::runtime {

void ChargedForecasts::offer(const TimedScene& newest) {
  constexpr double rounding = 1e-9;  // [s]
  const double now = newest.scene.time;
  if (now < free_at_ - rounding) {
    return;
  }
  free_at_ = now + std::max(verdict_period, cost_);
  rounds_.push_back(newest);
  while (rounds_.size() > 1 && is_ready(rounds_[1], now)) {
    rounds_.pop_front();
  }
}

std::optional<NumberedVerdict> ChargedForecasts::take(double now) {
  std::optional<TimedScene> newest;
  while (!rounds_.empty() && is_ready(rounds_.front(), now)) {
    newest = rounds_.front();
    rounds_.pop_front();
  }
  if (!newest) {
    return std::nullopt;
  }
  return NumberedVerdict{judge_(newest->scene, newest->beliefs, newest->under_way), newest->number};
}

}  // namespace saca::runtime

#include "saca/runtime/charged_forecasts.h"

#include <algorithm>

namespace saca::runtime {

void ChargedForecasts::offer(const TimedScene& newest) {
  constexpr double rounding = 1e-9;  // [s]
  const double now = newest.scene.time;
  if (now < free_at_ - rounding) {
    return;
  }
  const double cost = cost_(newest);
  free_at_ = now + std::max(verdict_period, cost);
  rounds_.push_back({newest, now + cost});
  while (rounds_.size() > 1 && rounds_[1].ready <= now) {
    rounds_.pop_front();
  }
}

std::optional<NumberedVerdict> ChargedForecasts::take(double now) {
  std::optional<TimedScene> newest;
  while (!rounds_.empty() && rounds_.front().ready <= now) {
    newest = rounds_.front().of;
    rounds_.pop_front();
  }
  if (!newest) {
    return std::nullopt;
  }
  return NumberedVerdict{judge_(newest->scene, newest->beliefs, newest->under_way), newest->number};
}

}  // namespace saca::runtime

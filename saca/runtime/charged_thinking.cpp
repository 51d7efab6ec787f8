#include "saca/runtime/charged_thinking.h"

#include <algorithm>

namespace saca::runtime {

void ChargedThinking::think(arbitration::ThinkingPlane& plane, const world::Scene& scene,
                            const intent::Beliefs& beliefs) {
  if (scene.time < free_at_) {
    return;
  }
  constexpr double shortest_round = 0.2;  // [s], as the thinking thread's breath
  clock_.set(from_seconds(scene.time + round_));
  if (plane.think(scene, beliefs, from_seconds(scene.time))) {
    free_at_ = std::max(free_at_, scene.time + std::max(round_, shortest_round));
  }
}

void ChargedThinking::publish(const reflex::PlanCache& plans, double ready) {
  waiting_.emplace_back(ready, plans);
  busy_until(ready);
}

std::optional<reflex::PlanCache> ChargedThinking::take(double now) {
  std::optional<reflex::PlanCache> newest;
  while (!waiting_.empty() && waiting_.front().first <= now) {
    newest = waiting_.front().second;
    waiting_.pop_front();
  }
  return newest;
}

}  // namespace saca::runtime

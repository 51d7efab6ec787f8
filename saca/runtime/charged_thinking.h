#pragma once

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/onboard/reflex/plan_cache.h"
#include "saca/thinking/arbitration/thinking_plane.h"
#include "saca/thinking/intent/observer.h"

namespace saca::runtime {

/// Thinking in pace `lockstep`: on the same thread, its plans held back until the simulated time at
/// which they would have been ready.
class ChargedThinking {
 public:
  /// @param round  what forecasts and rollouts of one round cost [s], >= 0
  /// @param clock  simulated; set to the time at which the forecasts are made
  ChargedThinking(double round, ManualClock& clock) : round_(round), clock_(clock) {}

  /// Thinks about the scene unless the last round is still being charged.
  void think(arbitration::ThinkingPlane& plane, const world::Scene& scene,
             const intent::Beliefs& beliefs);

  /// For `arbitration::ThinkingOutput`: plans that are ready at `ready` [s].
  void publish(const reflex::PlanCache& plans, double ready);

  /// Something comes of the round at `time` [s], an answer whatever it is worth: until then nothing
  /// else is thought about.
  void busy_until(double time) { free_at_ = std::max(free_at_, time); }

  /// What was thought is of no use any more: plans that are not ready yet will not come. Whoever
  /// thinks is as busy as before.
  void forget() { waiting_.clear(); }

  /// Time jumped: whoever thinks is free.
  void begin_anew() {
    forget();
    free_at_ = never;
  }

  /// The newest plans that are ready at `now` [s] and have not been taken.
  [[nodiscard]] std::optional<reflex::PlanCache> take(double now);

 private:
  static constexpr double never = -std::numeric_limits<double>::infinity();

  double round_;
  ManualClock& clock_;
  std::deque<std::pair<double, reflex::PlanCache>> waiting_;
  double free_at_ = never;
};

}  // namespace saca::runtime

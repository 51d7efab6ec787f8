#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "saca/runtime/work_thread.h"
#include "saca/thinking/arbitration/forecaster.h"

namespace saca::runtime {

/// How often a verdict is made at most [s].
constexpr double verdict_period = 0.05;

/// The forecaster in pace `lockstep`: a round begins every `verdict_period`, and its verdict is
/// held back until the simulated time at which it would have been ready. A round whose verdict
/// nobody takes is not worked out.
class ChargedForecasts {
 public:
  using Cost = std::function<double(const TimedScene&)>;

  /// @param cost  of the verdict of a scene [s], >= 0
  ChargedForecasts(arbitration::Judge judge, Cost cost)
      : judge_(std::move(judge)), cost_(std::move(cost)) {}

  /// Begins a round unless the last one was begun less than a period ago, or is still worked on.
  void offer(const TimedScene& newest);

  /// The encounter is over: verdicts of its scenes will not come. The forecaster is as busy as
  /// before.
  void forget() { rounds_.clear(); }

  /// Time jumped: the forecaster is free.
  void begin_anew() {
    forget();
    free_at_ = never;
  }

  /// The newest verdict that is ready at `now` [s] and has not been taken.
  [[nodiscard]] std::optional<NumberedVerdict> take(double now);

 private:
  static constexpr double never = -std::numeric_limits<double>::infinity();

  struct Round {
    TimedScene of;
    double ready = 0.0;  ///< [s]
  };

  arbitration::Judge judge_;
  Cost cost_;
  std::deque<Round> rounds_;  ///< by time; what nobody can take any more is dropped
  double free_at_ = never;    ///< [s]
};

}  // namespace saca::runtime

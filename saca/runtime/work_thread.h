#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "saca/base/core/clock.h"
#include "saca/base/core/latest_slot.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/intent/observer.h"

namespace saca::runtime {

/// A scene, what its road users are thought to intend, when it was true, and what was under way.
struct TimedScene {
  world::Scene scene;
  intent::Beliefs beliefs;
  Clock::Time at{0};
  std::optional<reflex::UnderWay> under_way;
  std::uint32_t encounter = 0;  ///< counted from the first on
  std::uint64_t number = 0;     ///< of the scene, likewise
};

/// A verdict, and which scene it is of (TimedScene::number).
struct NumberedVerdict {
  reflex::Verdict verdict;
  std::uint64_t scene = 0;
};

/// Works beside the reflex plane: takes the newest scene, works on it, rests, takes the next.
/// Only finish() and the destructor wait for it. An exception ends the round, not the thread: the
/// first is kept for finish(), and the next scene is worked on as usual.
class WorkThread {
 public:
  using Work = std::function<void(const TimedScene&, const std::stop_token&)>;

  /// @param scenes  outlives the thread, as does `clock`
  /// @param breath  from the end of one round to the next
  WorkThread(LatestSlot<TimedScene>& scenes, Clock& clock, Clock::Time breath, Work work);
  WorkThread(const WorkThread&) = delete;
  WorkThread& operator=(const WorkThread&) = delete;
  /// As finish().
  ~WorkThread() = default;

  /// Ends the thread: withdraws what it waits for, and waits for the rest of the round under way.
  /// @return  what was thrown there first; empty when nothing was
  std::string finish();

  /// Once finished: processor time of the thread [s].
  [[nodiscard]] double computed() const { return computed_; }

 private:
  void run(const std::stop_token& stop);
  void note(const std::string& fault);

  LatestSlot<TimedScene>& scenes_;
  Clock& clock_;
  Clock::Time breath_;
  Work work_;
  std::string fault_;      ///< of the thread until it has ended
  double computed_ = 0.0;  ///< likewise
  std::jthread thread_;
};

}  // namespace saca::runtime

#pragma once

#include <stop_token>
#include <string>
#include <thread>

#include "saca/core/clock.h"
#include "saca/core/latest_slot.h"
#include "saca/decide/thinking_plane.h"
#include "saca/intent/observer.h"
#include "saca/world/scene.h"

namespace saca::loop {

/// A scene, what its road users are thought to intend, and when it was true.
struct TimedScene {
  world::Scene scene;
  intent::Beliefs beliefs;
  Clock::Time at{0};
};

/// Runs a thinking plane beside the reflex plane: takes the newest scene, thinks, takes the next.
/// Nobody ever waits for it but its destructor.
class ThinkingThread {
 public:
  /// All three outlive the thread.
  ThinkingThread(decide::ThinkingPlane& plane, LatestSlot<TimedScene>& scenes, Clock& clock);
  ThinkingThread(const ThinkingThread&) = delete;
  ThinkingThread& operator=(const ThinkingThread&) = delete;
  /// As finish().
  ~ThinkingThread() = default;

  /// Ends the thread: withdraws what is asked of the language model, and waits for the rest of the
  /// round under way.
  /// @return  what was thrown there and ended thinking early; empty when nothing was
  std::string finish();

 private:
  void run(const std::stop_token& stop);

  decide::ThinkingPlane& plane_;
  LatestSlot<TimedScene>& scenes_;
  Clock& clock_;
  std::string fault_;  ///< of the thread until it has ended
  std::jthread thread_;
};

}  // namespace saca::loop

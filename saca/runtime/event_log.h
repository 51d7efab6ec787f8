#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <type_traits>
#include <variant>

#include "saca/base/core/spsc_queue.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/thinking/arbitration/event.h"

namespace saca::runtime {

/// What an avoider reports besides its decisions.
enum class Remark : std::uint8_t {
  encounter_over,  ///< the next one finds nothing of it
  new_drive,       ///< the scenes' time jumped: what was known is forgotten
  degraded,        ///< from now on somebody or everything is carried on instead of seen
  unusable,        ///< from now on there is no scene to decide by
  seen_again,      ///< neither holds any more
};

/// Events of an avoider, from the threads in which they happen to one that has the time to read
/// them. The driving thread hands over numbers, of which the reading thread makes text.
///
/// The queues are bounded. What does not fit is counted; after what did fit, one event reports how
/// many are missing.
class EventLog {
 public:
  /// @param capacity  of each of the two queues, >= 1
  explicit EventLog(std::size_t capacity);

  // The driving thread. These neither wait nor allocate.

  /// @param by    who set it off
  /// @param left  to the conflict [s]
  void triggered(const reflex::Decision& decision, const world::Actor& by, double left) noexcept;
  /// @param time  [s], in the scene's time
  void switched(double time, const reflex::Switch& change) noexcept;
  void remark(double time, Remark remark) noexcept;

  // The thinking thread. It does not wait.
  void thought(arbitration::Event event) noexcept;

  /// The reading thread: the oldest event of the driving thread, else of the thinking one, that has
  /// not been read; nullopt: there is none now.
  [[nodiscard]] std::optional<arbitration::Event> next();

 private:
  struct TriggerEntry {
    reflex::Decision decision;
    world::Actor by;
    double left = 0.0;  ///< [s]
  };
  struct Notice {
    double time = 0.0;  ///< [s]
    std::variant<Remark, TriggerEntry, reflex::Switch> what;
  };
  static_assert(std::is_trivially_copyable_v<Notice>);

  void add_events_of(const Notice& notice);
  [[nodiscard]] std::optional<arbitration::Event> rejected(arbitration::Plane plane,
                                                           std::size_t count,
                                                           std::size_t& told) const;

  SpscQueue<Notice> notices_;
  SpscQueue<arbitration::Event> thoughts_;
  // The reading thread's own:
  std::deque<arbitration::Event> read_;  ///< of the last notice
  double time_ = 0.0;                    ///< of the last event [s]
  std::size_t notices_rejected_told_ = 0;
  std::size_t thoughts_rejected_told_ = 0;
};

}  // namespace saca::runtime

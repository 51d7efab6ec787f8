#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <stop_token>
#include <string>
#include <thread>
#include <variant>

#include "saca/base/core/spsc_queue.h"
#include "saca/lab/encounter/listener.h"
#include "saca/thinking/arbitration/event.h"

namespace saca::encounter {

/// Tells a listener what happens, on a thread of its own: the listener may block for as long as it
/// likes, and no thread that hands something over waits for it.
///
/// Two threads hand over, each to a bounded queue (SpscQueue). What does not fit because the
/// listener has blocked for long is counted; once the listener has heard what did fit, one event
/// reports how many it missed.
class Dispatcher {
 public:
  /// The thread that hands over.
  enum class Producer : std::uint8_t { driving, thinking };

  static constexpr std::size_t usual_capacity = 1'024;  ///< some ten times what a run has to tell

  /// @param listener  outlives this
  /// @param capacity  of each queue, in events and pieces of reasoning, >= 1
  explicit Dispatcher(Listener& listener, std::size_t capacity = usual_capacity);
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;
  /// As finish(), but what the listener has thrown is dropped.
  ~Dispatcher() = default;

  /// Hands an event over; waits for nobody.
  void event(Producer producer, arbitration::Event event) noexcept;
  /// Likewise a piece of what the model writes about a preview, on the thread that thinks.
  void reasoning(std::int32_t preview, std::string text) noexcept;

  /// Nothing is handed over any more: waits until the listener has heard all.
  /// @throws  what the listener has thrown; it has heard nothing since
  void finish();

 private:
  struct Reasoning {
    std::int32_t preview = 0;
    std::string text;
  };
  using Message = std::variant<arbitration::Event, Reasoning>;
  /// Of one producer.
  struct Lane {
    explicit Lane(std::size_t capacity) : queue(capacity) {}
    SpscQueue<Message> queue;
    std::size_t num_rejected_told = 0;  ///< the telling thread's own
  };

  [[nodiscard]] Lane& lane(Producer producer) { return lanes_[static_cast<std::size_t>(producer)]; }
  [[nodiscard]] Lane* next_lane();
  void run(const std::stop_token& stop);
  void tell_all();
  void tell_rejected();

  Listener& listener_;
  std::array<Lane, 2> lanes_;
  double time_ = 0.0;           ///< of the last event heard [s]; this thread's own, as the next
  std::exception_ptr problem_;  ///< what the listener has thrown
  std::jthread thread_;
};

}  // namespace saca::encounter

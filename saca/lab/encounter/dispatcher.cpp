#include "saca/lab/encounter/dispatcher.h"

#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <utility>

namespace saca::encounter {
namespace {

using arbitration::Event;

constexpr auto pause = std::chrono::milliseconds(5);  // between looks at empty queues

}  // namespace

Dispatcher::Dispatcher(Listener& listener, std::size_t capacity)
    : listener_(listener),
      lanes_{Lane(capacity), Lane(capacity)},
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Dispatcher::event(Producer producer, Event event) noexcept {
  lane(producer).queue.push(std::move(event));
}

void Dispatcher::reasoning(std::int32_t preview, std::string text) noexcept {
  lane(Producer::thinking).queue.push(Reasoning{preview, std::move(text)});
}

void Dispatcher::finish() {
  thread_.request_stop();
  if (thread_.joinable()) {
    thread_.join();
  }
  if (problem_) {
    std::rethrow_exception(std::exchange(problem_, nullptr));
  }
}

// It looks from time to time, because waking it would be a system call of the driving thread.
void Dispatcher::run(const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any stopped;
  try {
    bool is_last = false;
    while (!is_last) {
      is_last = stop.stop_requested();  // before the look, which then finds all there is
      tell_all();
      stopped.wait_for(lock, stop, pause, [] { return false; });
    }
  } catch (...) {
    problem_ = std::current_exception();
  }
}

void Dispatcher::tell_all() {
  while (Lane* const next = next_lane()) {
    const Message message = *next->queue.pop();
    if (const auto* const event = std::get_if<Event>(&message)) {
      time_ = event->time;
      listener_.on_event(*event);
    } else {
      const auto& reasoning = std::get<Reasoning>(message);
      listener_.on_reasoning(reasoning.preview, reasoning.text);
    }
  }
  tell_rejected();
}

/// The one whose oldest message comes first; nullptr: both are empty.
Dispatcher::Lane* Dispatcher::next_lane() {
  Lane* next = nullptr;
  double earliest = std::numeric_limits<double>::infinity();
  for (Lane& one : lanes_) {
    if (const Message* const message = one.queue.front()) {
      const auto* const event = std::get_if<Event>(message);
      const double time = event == nullptr ? time_ : event->time;  // reasoning has none of its own
      if (next == nullptr || time < earliest) {
        next = &one;
        earliest = time;
      }
    }
  }
  return next;
}

void Dispatcher::tell_rejected() {
  for (const Producer producer : {Producer::driving, Producer::thinking}) {
    Lane& one = lane(producer);
    const std::size_t count = one.queue.num_rejected();
    if (count > one.num_rejected_told) {
      const std::size_t num_new = count - std::exchange(one.num_rejected_told, count);
      listener_.on_event(arbitration::events_not_told(
          time_,
          producer == Producer::driving ? arbitration::Plane::reflex : arbitration::Plane::thinking,
          num_new));
    }
  }
}

}  // namespace saca::encounter

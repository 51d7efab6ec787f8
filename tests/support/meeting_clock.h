#pragma once

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "saca/base/core/clock.h"

namespace saca {

/// Time that threads share in a test: it stands still while one of them works, and goes on to the
/// earliest moment that is waited for when all of them wait. Whatever a busy machine takes for a
/// piece of work, it takes no time here.
///
/// Time waits for `num_threads` threads from the start: one that has not waited yet is at work. A
/// thread other than the one that made the clock leaves it when it ends; it must have waited once,
/// and on no other clock. Who is told to stop while it waits counts as waiting until it runs, so
/// time may go on before it does. The clock outlives these threads.
class MeetingClock final : public Clock {
 public:
  /// @param num_threads  that time waits for, this one included, >= 1
  explicit MeetingClock(int num_threads) : num_threads_(num_threads) {}

  [[nodiscard]] Time now() const noexcept override {
    const std::lock_guard guard(lock_);
    return now_;
  }
  void wait_until(Time time) noexcept override { wait_until_or_stop(time, {}); }
  void wait_until_or_stop(Time time, const std::stop_token& stop) noexcept override {
    if (std::this_thread::get_id() != maker_) {
      static thread_local Member member;
      member.clock = this;
    }
    std::unique_lock guard(lock_);
    if (time <= now_) {
      return;
    }
    const auto waiting = awaited_.insert(time);
    go_on();
    moved_.wait(guard, stop, [&] { return now_ >= time; });
    awaited_.erase(waiting);
  }

 private:
  struct Member {
    MeetingClock* clock = nullptr;
    Member() = default;
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;
    ~Member() { clock->leave(); }
  };

  void leave() {
    const std::lock_guard guard(lock_);
    --num_threads_;
    go_on();
  }
  void go_on() {
    // Who has been woken but does not run yet still stands in the set, at a time that has come.
    if (static_cast<int>(awaited_.size()) >= num_threads_ && !awaited_.empty() &&
        *awaited_.begin() > now_) {
      now_ = *awaited_.begin();
      moved_.notify_all();
    }
  }

  const std::thread::id maker_ = std::this_thread::get_id();
  mutable std::mutex lock_;
  std::condition_variable_any moved_;
  std::multiset<Time> awaited_;
  Time now_{0};
  int num_threads_;
};

}  // namespace saca

#pragma once

#include <algorithm>
#include <atomic>

#include "saca/base/core/clock.h"

namespace saca::language_model {

// Stands still, or goes on by a step at each look: what takes real time (a process, a connection)
// never decides a test, a stopped clock waits for it and a stepping one runs past it.
class SteppingClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override { return Time(now_ += step_.load()); }
  void wait_until(Time time) noexcept override { now_ = std::max(now_.load(), time.count()); }
  // Without a step.
  [[nodiscard]] Time last_look() const { return Time(now_.load()); }
  void step(Time by) { step_ = by.count(); }

 private:
  mutable std::atomic<Time::rep> now_{0};
  std::atomic<Time::rep> step_{0};
};

}  // namespace saca::language_model

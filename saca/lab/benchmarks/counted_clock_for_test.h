#pragma once

// A clock for the tests of this module.

#include "saca/base/core/clock.h"

namespace saca::benchmarks {

/// Every look at it takes a microsecond.
class CountedClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override {
    now_ += std::chrono::microseconds(1);
    return now_;
  }
  void wait_until(Time time) noexcept override { now_ = time > now_ ? time : now_; }

 private:
  mutable Time now_{0};
};

}  // namespace saca::benchmarks

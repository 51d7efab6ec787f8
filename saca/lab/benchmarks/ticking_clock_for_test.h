#pragma once

#include <chrono>

#include "saca/base/core/clock.h"

namespace saca::benchmarks {

/// Goes on by a millisecond each time that it is asked.
class TickingClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override {
    now_ += std::chrono::milliseconds(1);
    return now_;
  }
  void wait_until(Time /*time*/) noexcept override {}

 private:
  mutable Time now_{0};
};

}  // namespace saca::benchmarks

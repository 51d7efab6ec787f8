#include "saca/core/clock.h"

#include <algorithm>
#include <thread>

namespace saca {

Clock::Time SteadyClock::now() const noexcept {
  return std::chrono::steady_clock::now().time_since_epoch();
}

void SteadyClock::wait_until(Time time) noexcept {
  std::this_thread::sleep_until(
      std::chrono::steady_clock::time_point(std::chrono::steady_clock::duration(time)));
}

void ManualClock::wait_until(Time time) noexcept {
  now_ = std::max(now_, time);
}

}  // namespace saca

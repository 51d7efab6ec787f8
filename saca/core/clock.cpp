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

void wait_until(Clock& clock, Clock::Time time, const std::stop_token& stop) noexcept {
  constexpr Clock::Time longest_look = std::chrono::milliseconds(10);  // between looks at `stop`
  if (!stop.stop_possible()) {
    clock.wait_until(time);
    return;
  }
  for (Clock::Time now = clock.now(); now < time && !stop.stop_requested(); now = clock.now()) {
    clock.wait_until(std::min(time, now + longest_look));
  }
}

}  // namespace saca

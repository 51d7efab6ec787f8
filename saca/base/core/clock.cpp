#include "saca/base/core/clock.h"

#include <algorithm>
#include <thread>

namespace saca {

void Clock::wait_until_or_stop(Time time, const std::stop_token& stop) noexcept {
  constexpr Time longest_look = std::chrono::milliseconds(10);  // between looks at `stop`
  if (!stop.stop_possible()) {
    wait_until(time);
    return;
  }
  for (Time at = now(); at < time && !stop.stop_requested(); at = now()) {
    wait_until(std::min(time, at + longest_look));
  }
}

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

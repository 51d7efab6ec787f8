#pragma once

#include <chrono>
#include <stop_token>

namespace saca {

/// Real time since some fixed start. Comes in as an argument everywhere; simulated time is
/// something else (a step count), and the two never mix.
class Clock {
 public:
  using Time = std::chrono::nanoseconds;

  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  [[nodiscard]] virtual Time now() const noexcept = 0;
  /// Returns at `time` or later; at once if it has passed.
  virtual void wait_until(Time time) noexcept = 0;
  /// The same, but no longer than until soon after a stop was asked for.
  virtual void wait_until_or_stop(Time time, const std::stop_token& stop) noexcept;
};

[[nodiscard]] inline double to_seconds(Clock::Time time) {
  return std::chrono::duration<double>(time).count();
}
/// @param seconds  within 292 years of 0
[[nodiscard]] inline Clock::Time from_seconds(double seconds) {
  return std::chrono::duration_cast<Clock::Time>(std::chrono::duration<double>(seconds));
}

/// The machine's monotonic clock.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override;
  void wait_until(Time time) noexcept override;
};

/// Stands still until told; waiting moves it on. For tests and simulated time.
class ManualClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override { return now_; }
  void wait_until(Time time) noexcept override;
  void advance(Time by) noexcept { now_ += by; }
  /// To any time, an earlier one too.
  void set(Time now) noexcept { now_ = now; }

 private:
  Time now_{0};
};

}  // namespace saca

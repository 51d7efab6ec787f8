#pragma once

#include <stop_token>
#include <thread>

namespace saca::long_work {

/// From here on SIGINT and SIGTERM do not end the process but are remembered.
void watch_for_interrupt();

/// Whether one came since.
[[nodiscard]] bool interrupted();

/// Asks for a stop soon after an interrupt that is watched for, as long as this lives.
class InterruptStop {
 public:
  InterruptStop();
  InterruptStop(const InterruptStop&) = delete;
  InterruptStop& operator=(const InterruptStop&) = delete;
  ~InterruptStop() = default;
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread thread_;  ///< a signal's handler may not ask for a stop itself
};

}  // namespace saca::long_work

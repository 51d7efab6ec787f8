#pragma once

#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "saca/base/core/clock.h"

namespace saca::app {

/// From here on SIGINT and SIGTERM do not end the program but are remembered.
void watch_for_interrupt();
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

/// What is worked on, on the error stream. On a terminal, in place: how far it is and how long the
/// rest will take. Anywhere else one line, when this ends: how far it came and how long it took.
class ProgressLine {
 public:
  /// @param all  how many steps there are at most, > 0
  ProgressLine(std::string_view what, int all, Clock& clock);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @param done        of the steps
  /// @param remembered  of these, how many took no time: they were done before
  /// @param more        what else there is to say of it; may be empty
  void show(int done, int remembered, const std::string& more);

 private:
  std::string what_;
  int all_;
  Clock& clock_;
  Clock::Time start_;
  Clock::Time last_;
  bool terminal_;
  bool shown_ = false;  ///< has anything been said of how far it is?
  int done_ = 0;
  std::string more_;
};

}  // namespace saca::app

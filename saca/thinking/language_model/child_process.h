#pragma once

#include <sys/types.h>

#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"

namespace saca::language_model {

/// A program in a process group of its own, spoken to in lines. No call waits past its deadline,
/// whatever the program does; no signal reaches the caller, no zombie stays.
///
/// It gets the environment without variables whose names tell of a secret (key, token, password),
/// no core dumps, at most 1024 open files of at most 1 GiB each; where memory is short, the system
/// ends it first.
class ChildProcess {
 public:
  /// @param command  program (found by its path alone) and its arguments, not empty
  ChildProcess(std::vector<std::string> command, Clock& clock);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Begins the program if it does not run; returns without waiting for it.
  /// @return  nullopt, or why it could not be begun (unreadable)
  [[nodiscard]] std::optional<Error> start();

  /// @return  nullopt when the line is with the program; too_late, or unreadable when it is gone
  [[nodiscard]] std::optional<Error> send(std::string_view line, Clock::Time deadline);

  /// The program's next line, without its end. Nobody waits on when a stop is asked for.
  /// @return  too_late, also when stopped; unreadable when the program is gone; malformed when the
  /// line has no end in
  ///          sight
  [[nodiscard]] Result<std::string> receive(Clock::Time deadline, const std::stop_token& stop = {});

  /// Ends the program and whatever it began, at once. May be called from any thread, also while
  /// another waits in send or receive: that one then sees that the program is gone.
  void kill() noexcept;

  [[nodiscard]] bool running() const;
  /// Its process id while it runs.
  [[nodiscard]] std::optional<pid_t> pid() const;

 private:
  [[nodiscard]] bool wait_for(short events, Clock::Time deadline,
                              const std::stop_token& stop = {}) const;
  void drop_connection() noexcept;
  void reap() noexcept;

  std::vector<std::string> command_;
  Clock& clock_;
  int socket_ = -1;     ///< used by the thread that sends and receives
  std::string unread_;  ///< received, not yet given on
  mutable std::mutex mutex_;
  pid_t pid_ = -1;             ///< guarded by mutex_
  std::vector<pid_t> ending_;  ///< killed, not yet gone; guarded by mutex_
};

}  // namespace saca::language_model

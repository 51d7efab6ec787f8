#pragma once

#include <ctime>

namespace saca {

/// What a POSIX clock of processor time says [s].
/// @param clock  CLOCK_THREAD_CPUTIME_ID: of the calling thread; CLOCK_PROCESS_CPUTIME_ID: of all
///               threads of this process; since they began
[[nodiscard]] inline double processor_seconds(clockid_t clock) {
  timespec used{};
  ::clock_gettime(clock, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace saca

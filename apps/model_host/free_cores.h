#pragma once

#include <sched.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>

#include "saca/base/core/processor_time.h"

namespace saca::model_host {

/// How long these processors were idle since the machine began, together, by the text of Linux's
/// /proc/stat [s].
/// @param is_ours            whether this process may run on a processor
/// @param ticks_per_second   of that text's numbers
/// @return                   nullopt: it names none of ours
inline std::optional<double> idle_seconds(const std::string& stat,
                                          const std::function<bool(int)>& is_ours,
                                          double ticks_per_second) {
  std::optional<double> all;
  std::istringstream lines(stat);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    double user = 0.0;
    double nice = 0.0;
    double system = 0.0;
    double idle = 0.0;
    double waiting = 0.0;
    words >> name >> user >> nice >> system >> idle >> waiting;
    constexpr std::size_t longest_name = 10;
    const bool is_processor = name.starts_with("cpu") && name.size() > 3 &&
                              name.size() <= longest_name &&
                              name.find_first_not_of("0123456789", 3) == std::string::npos;
    if (words && is_processor && is_ours(std::stoi(name.substr(3)))) {
      all = all.value_or(0.0) + (idle + waiting) / ticks_per_second;
    }
  }
  return all;
}

/// How many cores this process could have had of late: those that nobody used and those that it
/// used itself. By what the scheduler says, so that a slow machine is not taken for a busy one.
class FreeCores {
 public:
  /// @return  on average since the last call that returned something; nullopt: that was less than
  ///          0.1 s ago, which is too short for the clock of /proc/stat, or it cannot be read
  std::optional<double> since_last() {
    const Instant now{std::chrono::steady_clock::now(), idle_of_ours(),
                      processor_seconds(CLOCK_PROCESS_CPUTIME_ID)};
    const double passed = std::chrono::duration<double>(now.time - last_.time).count();
    if (!now.idle || (last_.idle && passed < shortest)) {
      return std::nullopt;
    }
    const Instant before = last_;
    last_ = now;
    if (!before.idle) {
      return std::nullopt;
    }
    return (*now.idle - *before.idle + now.own - before.own) / passed;
  }

 private:
  struct Instant {
    std::chrono::steady_clock::time_point time;
    std::optional<double> idle;  ///< [s]
    double own = 0.0;            ///< processor time [s]
  };
  static constexpr double shortest = 0.1;  // [s]

  static std::optional<double> idle_of_ours() {
    cpu_set_t ours;
    CPU_ZERO(&ours);
    if (sched_getaffinity(0, sizeof ours, &ours) != 0) {
      return std::nullopt;
    }
    std::ifstream file("/proc/stat");
    std::ostringstream text;
    text << file.rdbuf();
    return idle_seconds(
        text.str(),
        [&](int cpu) {
          return cpu < CPU_SETSIZE && CPU_ISSET(static_cast<std::size_t>(cpu), &ours);
        },
        static_cast<double>(sysconf(_SC_CLK_TCK)));
  }

  Instant last_{};
};

}  // namespace saca::model_host

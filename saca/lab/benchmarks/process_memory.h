#pragma once

#include <istream>
#include <string>

namespace saca::benchmarks {

/// A line of what Linux tells in /proc/PID/status, by its name, such as VmRSS [MiB]; 0: there is
/// none.
[[nodiscard]] double status_memory(std::istream& status, const std::string& name);

/// Likewise of this process.
[[nodiscard]] double process_memory(const std::string& name);

/// From here on VmHWM is the peak since now, where the system lets us.
void forget_memory_peak();

}  // namespace saca::benchmarks

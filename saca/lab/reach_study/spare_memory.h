#pragma once

#include <istream>
#include <optional>

namespace saca::reach_study {

/// The line `MemAvailable:` of what Linux tells in /proc/meminfo [MiB]; nullopt: there is none.
[[nodiscard]] std::optional<double> available_memory(std::istream& meminfo);

/// What the system can give without swapping [MiB]; nullopt: it does not say.
[[nodiscard]] std::optional<double> spare_memory();

}  // namespace saca::reach_study

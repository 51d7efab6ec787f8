#pragma once

#include <string>

namespace saca::app {

/// The command that was typed, as a shell would take it again; the program is "saca".
[[nodiscard]] std::string invocation();

/// The date and time in UTC as ISO 8601 has it, to the second.
[[nodiscard]] std::string now_in_utc();

}  // namespace saca::app

#pragma once

#include <string>

namespace saca::shell {

/// The command that was typed, as a shell would take it again; the program is "saca".
[[nodiscard]] std::string invocation();
/// Likewise of the words of a process.
/// @param words  each with a 0 behind it, as /proc/self/cmdline has them; the first is the program
[[nodiscard]] std::string invocation_of(const std::string& words);

/// The date and time in UTC as ISO 8601 has it, to the second.
[[nodiscard]] std::string now_in_utc();

/// Whether a standard file understands colours and wants them: it is a terminal, and NO_COLOR is
/// not set (https://no-color.org: to any value but an empty one).
[[nodiscard]] bool wants_colours(int file);

}  // namespace saca::shell

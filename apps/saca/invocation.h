#pragma once

#include <string>
#include <string_view>

namespace saca::app {

/// A text as a shell takes it literally, between single quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The command that was typed, as a shell would take it again; the program is "saca".
[[nodiscard]] std::string invocation();

/// The date and time in UTC as ISO 8601 has it, to the second.
[[nodiscard]] std::string now_in_utc();

}  // namespace saca::app

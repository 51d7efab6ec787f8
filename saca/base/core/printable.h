#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace saca {

/// A foreign text as a terminal may get it: nothing in it is a command. Control characters (C0 but
/// newlines, DEL, C1, and those that end lines or turn their order) become spaces, bytes that are
/// no UTF-8 become U+FFFD.
[[nodiscard]] std::string printable(std::string_view text);

/// Is it UTF-8 to the last byte (RFC 3629)?
[[nodiscard]] bool is_utf8(std::string_view text);

/// The beginning of a foreign text as a message may hold it: one line, printable.
///
/// @param most  characters; where there are more, "..." follows them
[[nodiscard]] std::string one_line(std::string_view text, std::size_t most = 200);

}  // namespace saca

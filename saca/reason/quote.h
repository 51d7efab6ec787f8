#pragma once

#include <string>
#include <string_view>

namespace saca::reason {

/// The beginning of a foreign text as an error's message may hold it: one line of whole characters,
/// at most 200 of them, spaces where control characters or ends of lines were.
///
/// @param secret  never shown: eight or more of its characters in a row become "***", wherever the
///                text was cut; all of it where it has fewer. May be empty.
[[nodiscard]] std::string quote(std::string_view text, std::string_view secret);

}  // namespace saca::reason

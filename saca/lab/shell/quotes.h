#pragma once

#include <string>
#include <string_view>

namespace saca::shell {

/// A text as a shell takes it literally, between single quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A word as a shell takes it: in single quotes where it would see more in it than a word.
[[nodiscard]] std::string quoted_word(std::string_view word);

}  // namespace saca::shell

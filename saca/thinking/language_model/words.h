#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace saca::language_model {

/// ASCII letters in lower case, for looking up words.
[[nodiscard]] char lowered(char c);
[[nodiscard]] std::string lowered(std::string_view text);

/// An ASCII letter or digit, or `_`.
[[nodiscard]] bool is_word_char(char c);

/// Where a word or phrase stands in lower-case text, not as a part of a longer word.
/// @param from  where to begin to look
[[nodiscard]] std::optional<std::size_t> find_phrase(std::string_view low, std::string_view phrase,
                                                     std::size_t from = 0);
[[nodiscard]] bool has_phrase(std::string_view low, std::string_view phrase);
template <std::size_t n>
[[nodiscard]] bool has_any(std::string_view low, const std::array<std::string_view, n>& phrases) {
  return std::any_of(phrases.begin(), phrases.end(),
                     [&](std::string_view phrase) { return has_phrase(low, phrase); });
}

/// Lines, cut further where a sentence ends within one. A dot between digits ends none.
/// @return  parts of `text`, none of them blank
[[nodiscard]] std::vector<std::string_view> sentences(std::string_view text);

}  // namespace saca::language_model

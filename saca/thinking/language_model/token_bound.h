#pragma once

#include <string_view>

namespace saca::language_model {

/// How many tokens a prompt has at most, by the tokeniser of SmolLM2: digits, marks, line ends and
/// the space before a digit are tokens of their own; so is a word with the space before it, but for
/// a few. Holds for the words of `scene_part`, which are few and fixed; a test asks the tokeniser.
[[nodiscard]] int tokens_at_most(std::string_view text);

}  // namespace saca::language_model

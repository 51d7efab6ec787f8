#include "saca/thinking/language_model/token_bound.h"

#include <algorithm>
#include <array>

namespace saca::language_model {
namespace {

constexpr bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}
constexpr bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

// Of several tokens: what the tokeniser's vocabulary does not hold with a space before it.
constexpr std::array<std::string_view, 4> in_two{"kerb", "hindsight", "oncoming", "sliding"};
constexpr std::array<std::string_view, 6> split_at_line_start{"truck",      "motorcycle", "bicycle",
                                                              "pedestrian", "obstacle",   "nobody"};

template <std::size_t n>
bool holds(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

int tokens_at_most(std::string_view text) {
  int tokens = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_small(text[i])) {
      const bool joins_word = text[i] == ' ' && i + 1 < text.size() &&
                              (is_small(text[i + 1]) || is_capital(text[i + 1]));
      tokens += joins_word ? 0 : 1;
      continue;
    }
    const std::size_t begin = i;
    while (i + 1 < text.size() && is_small(text[i + 1])) {
      ++i;
    }
    const std::string_view word = text.substr(begin, i + 1 - begin);
    const bool starts_line = begin == 0 || text[begin - 1] == '\n';
    tokens += 1 + (holds(in_two, word) ? 1 : 0) +
              (starts_line && holds(split_at_line_start, word) ? 2 : 0);
  }
  return tokens;
}

}  // namespace saca::language_model

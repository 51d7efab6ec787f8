#include "saca/lab/shell/quotes.h"

#include <algorithm>

namespace saca::shell {

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char letter : text) {
    out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  }
  return out + "'";
}

std::string quoted_word(std::string_view word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=:,@+%").find(c) != std::string_view::npos;
  });
  return plain ? std::string(word) : in_quotes(word);
}

}  // namespace saca::shell

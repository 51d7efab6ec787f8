#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/contract.h"

/// Pieces of grammars in llama.cpp's notation.
namespace saca::language_model::gbnf {

/// The rule of the statement that a reply comes to, of texts that begin alike. A reply that has to
/// be brief goes there as soon as its grammar lets it.
constexpr std::string_view conclusion_rule = "conclusion";

/// A text as it stands.
inline std::string literal(std::string_view text) {
  expects(text.find_first_of("\"\\\n") == std::string_view::npos, "words without marks of GBNF");
  return fmt::format("\"{}\"", text);
}

/// Of these texts those that are not empty.
inline std::vector<std::string> literals(const std::vector<std::string>& texts) {
  std::vector<std::string> all;
  for (const std::string& text : texts) {
    if (!text.empty()) {
      all.push_back(literal(text));
    }
  }
  return all;
}

/// @param parts  at least one
inline std::string one_of(const std::vector<std::string>& parts) {
  return fmt::format("({})", fmt::join(parts, " | "));
}

/// One of these, or nothing.
inline std::string perhaps(const std::vector<std::string>& parts) {
  return parts.empty() ? "" : one_of(parts) + "?";
}

}  // namespace saca::language_model::gbnf

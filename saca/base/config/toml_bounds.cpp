#include "saca/base/config/toml_bounds.h"

#include <algorithm>

namespace saca::config {
namespace {

// Bytes of the string that begins a text; all of it where the string does not end.
std::size_t string_length(std::string_view text) {
  const char quote = text.front();
  const std::string three(3, quote);
  const std::string end = text.starts_with(three) ? three : three.substr(0, 1);
  std::size_t at = end.size();
  while (at < text.size() && !text.substr(at).starts_with(end)) {
    at += quote == '"' && text[at] == '\\' ? std::size_t{2} : std::size_t{1};
  }
  at = std::min(at + end.size(), text.size());
  // One of three quotes may end in up to two more, which belong to it.
  for (int i = 0; i < 2 && end.size() > 1 && at < text.size() && text[at] == quote; ++i) {
    ++at;
  }
  return at;
}

// Bytes of the string or comment that begins a text, else 1.
std::size_t piece_length(std::string_view text) {
  switch (text.front()) {
    case '"':
    case '\'':
      return string_length(text);
    case '#':
      return std::min(text.find('\n'), text.size());
    default:
      return 1;
  }
}

// How deep a text is, after what was taken of it.
struct Nesting {
  std::size_t depth = 0;
  std::size_t dots = 0;  // of a key, or a number: since what can stand between two of them

  // What begins a piece.
  void take(char first) {
    switch (first) {
      case '[':
      case '{':
        ++depth;
        dots = 0;
        break;
      case ']':
      case '}':
        depth -= depth > 0 ? 1 : 0;
        dots = 0;
        break;
      case '.':
        ++dots;
        break;
      case '\n':
      case '=':
      case ',':
        dots = 0;
        break;
      default:
        break;
    }
  }
};

}  // namespace

std::optional<TomlExcess> beyond(const TomlBounds& bounds, std::string_view text) {
  if (text.size() > bounds.bytes) {
    return TomlExcess{1, "want at most " + std::to_string(bounds.bytes) + " bytes, got " +
                             std::to_string(text.size())};
  }
  std::size_t line = 1;
  Nesting nesting;
  while (!text.empty()) {
    const std::string_view taken = text.substr(0, piece_length(text));
    nesting.take(taken.front());
    if (nesting.depth > bounds.depth) {
      return TomlExcess{line, "want arrays and tables within each other at most " +
                                  std::to_string(bounds.depth) + " deep, got more"};
    }
    if (nesting.dots >= bounds.depth) {
      return TomlExcess{
          line, "want keys of at most " + std::to_string(bounds.depth) + " parts, got one of more"};
    }
    line += static_cast<std::size_t>(std::count(taken.begin(), taken.end(), '\n'));
    text.remove_prefix(taken.size());
  }
  return std::nullopt;
}

}  // namespace saca::config

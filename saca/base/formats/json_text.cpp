#include "saca/base/formats/json_text.h"

namespace saca::formats {

std::optional<std::string> beyond(const JsonBounds& bounds, std::string_view text) {
  if (text.size() > bounds.bytes) {
    return "want JSON of at most " + std::to_string(bounds.bytes) + " bytes, got " +
           std::to_string(text.size());
  }
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      i += c == '\\' ? 1 : 0;  // what is escaped ends nothing
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > bounds.depth) {
        return "want JSON of at most " + std::to_string(bounds.depth) +
               " levels, got more at byte " + std::to_string(i);
      }
    } else if (c == ']' || c == '}') {
      depth -= depth > 0 ? 1 : 0;
    }
  }
  return std::nullopt;
}

}  // namespace saca::formats

#include "saca/base/core/printable.h"

#include <algorithm>

namespace saca {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

struct Character {
  std::size_t length = 1;  // [bytes]
  char32_t code = 0;
  bool valid = false;
};

// The UTF-8 character at the beginning of a text that is not empty. Source: RFC 3629, section 4.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80U) {
    return {1, lead, true};
  }
  const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < length) {
    return {};
  }
  char32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return {};
    }
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800U) || (length == 4 && code < 0x10000U);
  const bool surrogate = code >= 0xD800U && code <= 0xDFFFU;
  return overlong || surrogate || code > 0x10FFFFU ? Character{} : Character{length, code, true};
}

// U+0080 to U+009F command some terminals; U+2028 and U+2029 end lines, U+202A to U+202E and U+2066
// to U+2069 turn the order in which characters are shown.
bool is_control(char32_t code) {
  return code < 0x20U || (code >= 0x7FU && code < 0xA0U) || (code >= 0x2028U && code <= 0x202EU) ||
         (code >= 0x2066U && code <= 0x2069U);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!character.valid) {
      result += replacement;
    } else if (is_control(character.code) && character.code != U'\n') {
      result += ' ';
    } else {
      result += text.substr(0, character.length);
    }
    text.remove_prefix(character.length);
  }
  return result;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!character.valid) {
      return false;
    }
    text.remove_prefix(character.length);
  }
  return true;
}

std::string one_line(std::string_view text, std::size_t most) {
  constexpr std::size_t longest_character = 4;  // bytes
  std::string line = printable(text.substr(0, longest_character * (most + 1)));
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::size_t characters = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(line[i]) & 0xC0U) != 0x80U;
    if (begins && ++characters > most) {
      return line.substr(0, i) + "...";
    }
  }
  return line;
}

}  // namespace saca

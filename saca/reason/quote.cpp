#include "saca/reason/quote.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace saca::reason {
namespace {

constexpr std::size_t longest_quote = 200;  // characters
// Bytes that are looked at: 200 characters of four, and what stars make shorter.
constexpr std::size_t quoted_bytes = 4096;
constexpr std::size_t shortest_secret = 8;  // a shorter run may be chance

// How many characters of `text` stand in this order somewhere in `secret`.
std::size_t common_run(std::string_view text, std::string_view secret) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const std::string_view rest = secret.substr(i);
    const auto [in_text, in_secret] =
        std::mismatch(text.begin(), text.end(), rest.begin(), rest.end());
    longest = std::max(longest, static_cast<std::size_t>(in_text - text.begin()));
  }
  return longest;
}

std::string masked(std::string_view text, std::string_view secret) {
  const std::size_t shortest = std::min(shortest_secret, secret.size());
  std::string result;
  while (!text.empty()) {
    const std::size_t run = common_run(text, secret);
    const bool hide = run > 0 && run >= shortest;
    result += hide ? std::string_view("***") : text.substr(0, 1);
    text.remove_prefix(hide ? run : 1);
  }
  return result;
}

// Bytes that are no UTF-8 become U+FFFD, by the JSON library, which has to know them anyway.
std::string as_utf8(const std::string& bytes) {
  using Json = nlohmann::json;
  return Json::parse(Json(bytes).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

// Bytes of the control character at the beginning of `text`: 0 where there is none.
std::size_t control_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0x20U;
  };
  if (byte(0) < 0x20U || byte(0) == 0x7FU) {
    return 1;
  }
  // U+0080 to U+009F command some terminals, U+2028 and U+2029 end lines.
  if (byte(0) == 0xC2U && byte(1) < 0xA0U) {
    return 2;
  }
  return byte(0) == 0xE2U && byte(1) == 0x80U && (byte(2) == 0xA8U || byte(2) == 0xA9U) ? 3 : 0;
}

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

}  // namespace

std::string quote(std::string_view text, std::string_view secret) {
  const std::string whole = as_utf8(masked(text.substr(0, quoted_bytes), secret));
  std::string result;
  std::size_t characters = 0;
  for (std::size_t i = 0; i < whole.size();) {
    if (!continues_character(whole[i]) && ++characters > longest_quote) {
      break;
    }
    const std::size_t control = control_length(std::string_view(whole).substr(i));
    result += control > 0 ? ' ' : whole[i];
    i += std::max<std::size_t>(control, 1);
  }
  return result;
}

}  // namespace saca::reason

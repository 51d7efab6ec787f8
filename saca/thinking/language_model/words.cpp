#include "saca/thinking/language_model/words.h"

namespace saca::language_model {

char lowered(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lowered(std::string_view text) {
  std::string low(text);
  std::transform(low.begin(), low.end(), low.begin(), [](char c) { return lowered(c); });
  return low;
}

bool is_word_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || c == '_';
}

std::optional<std::size_t> find_phrase(std::string_view low, std::string_view phrase,
                                       std::size_t from) {
  for (std::size_t at = low.find(phrase, from); at != std::string_view::npos;
       at = low.find(phrase, at + 1)) {
    const std::size_t end = at + phrase.size();
    if ((at == 0 || !is_word_char(low[at - 1])) && (end == low.size() || !is_word_char(low[end]))) {
      return at;
    }
  }
  return std::nullopt;
}

bool has_phrase(std::string_view low, std::string_view phrase) {
  return find_phrase(low, phrase).has_value();
}

std::vector<std::string_view> sentences(std::string_view text) {
  std::vector<std::string_view> all;
  std::size_t begin = 0;
  const auto add = [&](std::size_t end) {
    const std::string_view one = text.substr(begin, end - begin);
    if (one.find_first_not_of(" \t\r\n.-*") != std::string_view::npos) {
      all.push_back(one);
    }
    begin = end;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool ends_here =
        (text[i] == '.' || text[i] == ';') && i + 1 < text.size() &&
        (text[i + 1] == ' ' || text[i + 1] == '\n') &&
        // "1. " at the start numbers the line
        text.substr(begin, i - begin).find_first_not_of(" -0123456789") != std::string_view::npos;
    if (text[i] == '\n' || ends_here) {
      add(i + 1);
    }
  }
  add(text.size());
  return all;
}

}  // namespace saca::language_model

#include "saca/thinking/language_model/quoted_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/words.h"

namespace saca::language_model {
namespace {

bool is_numeral(char c) {
  return c >= '0' && c <= '9';
}

bool ends_with_word(std::string_view text, std::string_view word) {
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text.size() >= word.size() &&
         std::equal(word.rbegin(), word.rend(), text.rbegin(),
                    [](char a, char b) { return lowered(a) == lowered(b); });
}

// "1.", "2)", "0 AEB" at the start of a line number the line; they quote nothing.
bool is_label(std::string_view text, std::size_t begin, std::size_t end) {
  std::size_t first = begin;
  while (first > 0 && (text[first - 1] == ' ' || text[first - 1] == '-')) {
    --first;
  }
  if (first > 0 && text[first - 1] != '\n') {
    return false;
  }
  const std::string_view rest = text.substr(end);
  if (rest.starts_with('.') || rest.starts_with(')') || rest.starts_with(':')) {
    return true;
  }
  return rest.size() > 1 && rest[0] == ' ' && rest[1] >= 'A' && rest[1] <= 'Z';
}

bool names_a_choice(std::string_view before) {
  constexpr std::array<std::string_view, 5> words{"policy", "action", "policies", "actions",
                                                  "Response to user:"};
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return ends_with_word(before, word); });
}

std::string unit_at(std::string_view rest) {
  if (rest.starts_with(' ')) {
    rest.remove_prefix(1);
  }
  constexpr std::array<std::string_view, 4> units{"m/s", "m", "s", "%"};
  for (const std::string_view unit : units) {
    const bool ends =
        rest.size() == unit.size() ||
        (rest.size() > unit.size() && !is_word_char(rest[unit.size()]) && rest[unit.size()] != '/');
    if (rest.starts_with(unit) && ends) {
      return std::string(unit);
    }
  }
  return "";
}

/// Whether a text begins with a whole word, whatever the case.
bool begins_with_word(std::string_view text, std::string_view word) {
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(),
                    [](char a, char b) { return a == lowered(b); }) &&
         (text.size() == word.size() || !is_word_char(text[word.size()]));
}

/// Whether a lone digit numbers a policy, anywhere in a line: "3 ES-B-L".
bool numbers_a_policy(std::string_view text, std::size_t begin, std::size_t end) {
  if (end != begin + 1 || end == text.size() || text[end] != ' ') {
    return false;
  }
  return std::any_of(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(),
                     [rest = text.substr(end + 1)](manoeuvre::PolicyId policy) {
                       return begins_with_word(rest, lowered(manoeuvre::name(policy)));
                     });
}

/// @param rest  what follows the number
std::string where_at(std::string_view rest, std::string_view unit) {
  constexpr std::array<std::string_view, 5> words{"ahead", "behind", "left", "right", "away"};
  const auto skip_space = [&rest] {
    if (rest.starts_with(' ')) {
      rest.remove_prefix(1);
    }
  };
  skip_space();
  rest.remove_prefix(unit.size());
  skip_space();
  for (const std::string_view article : {"to the ", "on the "}) {
    rest.remove_prefix(rest.starts_with(article) ? article.size() : 0);
  }
  const auto* const found = std::find_if(words.begin(), words.end(), [&](std::string_view word) {
    return begins_with_word(rest, word);
  });
  return found == words.end() ? "" : std::string(*found);
}

/// @param before  what precedes the number
std::string of_what_at(std::string_view before) {
  // Of two that end alike the longer is first.
  constexpr std::array<std::string_view, 14> words{"lane change left",
                                                   "lane change right",
                                                   "brake moving left",
                                                   "brake moving right",
                                                   "brake",
                                                   "maintain",
                                                   "cross the lane",
                                                   "stop",
                                                   "risk",
                                                   "harm",
                                                   "grip",
                                                   "left edge",
                                                   "right edge",
                                                   "edge"};
  const auto* const found = std::find_if(words.begin(), words.end(), [&](std::string_view word) {
    return ends_with_word(before, word);
  });
  return found == words.end() ? "" : std::string(*found);
}

std::size_t end_of_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_numeral(text[at])) {
    ++at;
  }
  return at;
}

}  // namespace

std::string_view joint_at(std::string_view text) {
  for (const std::string_view joint : {", and ", ", ", ",", " and ", " or ", "-", " to "}) {
    if (text.starts_with(joint)) {
      return joint;
    }
  }
  return {};
}

std::vector<QuotedNumber> quoted_numbers(std::string_view text) {
  std::vector<QuotedNumber> numbers;
  std::size_t choice_end = std::string_view::npos;  // of the last number that named a choice
  for (std::size_t i = 0; i < text.size();) {
    if (!is_numeral(text[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    i = end_of_digits(text, i);
    const std::size_t whole = i;
    if (i + 1 < text.size() && text[i] == '.' && is_numeral(text[i + 1])) {
      i = end_of_digits(text, i + 1);
    }
    const bool in_a_name = begin > 0 && is_word_char(text[begin - 1]);
    const bool in_a_list = choice_end != std::string_view::npos && i == begin + 1 &&
                           choice_end + joint_at(text.substr(choice_end)).size() == begin;
    if (in_a_name || is_label(text, begin, i) || numbers_a_policy(text, begin, i)) {
      continue;
    }
    if (in_a_list || names_a_choice(text.substr(0, begin))) {
      choice_end = i;
      continue;
    }
    QuotedNumber number{.text = std::string(text.substr(begin, i - begin)),
                        .unit = unit_at(text.substr(i)),
                        .after_equals = ends_with_word(text.substr(0, begin), "="),
                        .where = {},
                        .of_what = of_what_at(text.substr(0, begin))};
    number.where = where_at(text.substr(i), number.unit);
    number.value = std::strtod(number.text.c_str(), nullptr);
    number.resolution = whole == i ? 1.0 : std::pow(10.0, -static_cast<double>(i - whole - 1));
    numbers.push_back(std::move(number));
  }
  return numbers;
}

}  // namespace saca::language_model

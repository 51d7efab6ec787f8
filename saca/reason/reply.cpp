#include "saca/reason/reply.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace saca::reason {
namespace {

constexpr std::string_view answer_stem = "Response to user:";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool ends_with_word(std::string_view text, std::string_view word) {
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text.size() >= word.size() &&
         std::equal(word.rbegin(), word.rend(), text.rbegin(),
                    [](char a, char b) { return lower(a) == lower(b); });
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
  constexpr std::array<std::string_view, 4> words{"policy", "action", "policies", answer_stem};
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return ends_with_word(before, word); });
}

// The number without zeros that do not change it: "014.50" and "14.5" are one.
std::string normal_form(std::string_view number) {
  while (number.size() > 1 && number[0] == '0' && is_digit(number[1])) {
    number.remove_prefix(1);
  }
  if (number.find('.') != std::string_view::npos) {
    while (number.back() == '0') {
      number.remove_suffix(1);
    }
    if (number.back() == '.') {
      number.remove_suffix(1);
    }
  }
  return std::string(number);
}

std::vector<std::string> quoted_numbers(std::string_view text) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < text.size();) {
    if (!is_digit(text[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < text.size() && is_digit(text[i])) {
      ++i;
    }
    if (i + 1 < text.size() && text[i] == '.' && is_digit(text[i + 1])) {
      ++i;
      while (i < text.size() && is_digit(text[i])) {
        ++i;
      }
    }
    const bool in_a_name = begin > 0 && is_letter(text[begin - 1]);
    if (!in_a_name && !is_label(text, begin, i) && !names_a_choice(text.substr(0, begin))) {
      numbers.push_back(normal_form(text.substr(begin, i - begin)));
    }
  }
  return numbers;
}

}  // namespace

manoeuvre::PolicyId likeliest_policy(const Answer& answer) {
  const auto best = std::max_element(answer.probability.begin(), answer.probability.end());
  return manoeuvre::all_policies.at(static_cast<std::size_t>(best - answer.probability.begin()));
}

std::optional<manoeuvre::PolicyId> stated_policy(std::string_view text) {
  const std::size_t at = text.rfind(answer_stem);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  std::string_view rest = text.substr(at + answer_stem.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const bool one_digit = !rest.empty() && is_digit(rest[0]) &&
                         (rest.size() == 1 || (!is_digit(rest[1]) && !is_letter(rest[1])));
  const bool fraction = rest.size() > 2 && rest[1] == '.' && is_digit(rest[2]);
  if (!one_digit || fraction) {
    return std::nullopt;
  }
  return manoeuvre::policy_from(rest[0] - '0');
}

std::optional<manoeuvre::PolicyId> stated_so_far(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(' ') + 1);
  if (text.ends_with(answer_stem)) {
    text.remove_suffix(answer_stem.size());
  }
  return stated_policy(text);
}

std::optional<double> faithful_share(std::string_view text, std::string_view prompt) {
  const std::vector<std::string> quoted = quoted_numbers(text);
  if (quoted.empty()) {
    return std::nullopt;
  }
  const std::vector<std::string> in_prompt = quoted_numbers(prompt);
  const std::set<std::string> known(in_prompt.begin(), in_prompt.end());
  const auto found = std::count_if(quoted.begin(), quoted.end(), [&](const std::string& number) {
    return known.contains(number);
  });
  return static_cast<double>(found) / static_cast<double>(quoted.size());
}

}  // namespace saca::reason

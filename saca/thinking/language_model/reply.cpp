#include "saca/thinking/language_model/reply.h"

#include <algorithm>
#include <array>

#include "saca/base/core/names.h"
#include "saca/thinking/language_model/words.h"

namespace saca::language_model {
namespace {

constexpr std::string_view answer_stem = "Response to user:";
constexpr std::array<std::string_view, 3> kind_names{"first", "ended", "forced"};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string_view name(Answer::Kind kind) {
  return name_of(kind, kind_names);
}

std::optional<Answer::Kind> answer_kind_from(std::string_view name) {
  return value_from<Answer::Kind>(name, kind_names);
}

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
  const bool one_digit =
      !rest.empty() && is_digit(rest[0]) && (rest.size() == 1 || !is_word_char(rest[1]));
  const bool fraction = rest.size() > 2 && rest[1] == '.' && is_digit(rest[2]);
  if (!one_digit || fraction) {
    return std::nullopt;
  }
  return manoeuvre::policy_from(rest[0] - '0');
}

std::string_view finished_part(const Reply& reply) {
  const std::string_view text = reply.reasoning;
  if (!reply.answers.empty() && reply.answers.back().kind == Answer::Kind::ended) {
    return text;
  }
  // A dot after a digit may be one within a number, or the end of a label ("1. ").
  for (std::size_t end = text.size(); end > 0; --end) {
    const bool of_sentence = text[end - 1] == '.' && end > 1 && !is_digit(text[end - 2]) &&
                             (end == text.size() || text[end] == ' ');
    if (text[end - 1] == '\n' || text[end - 1] == ';' || of_sentence) {
      return text.substr(0, end);
    }
  }
  return {};
}

std::optional<manoeuvre::PolicyId> stated_so_far(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(' ') + 1);
  if (text.ends_with(answer_stem)) {
    text.remove_suffix(answer_stem.size());
  }
  return stated_policy(text);
}

}  // namespace saca::language_model

#include "saca/thinking/language_model/conclusion.h"

#include <algorithm>
#include <cstddef>

namespace saca::language_model {
namespace {

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_part_of_a_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
}

bool begins_with_name(std::string_view text, std::string_view name) {
  return text.size() >= name.size() &&
         std::equal(name.begin(), name.end(), text.begin(),
                    [](char a, char b) { return a == upper(b); }) &&
         (text.size() == name.size() || !is_part_of_a_word(upper(text[name.size()])));
}

}  // namespace

std::optional<manoeuvre::PolicyId> first_named(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (at > 0 && is_part_of_a_word(upper(text[at - 1]))) {
      continue;
    }
    const auto* const found =
        std::find_if(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(),
                     [&](manoeuvre::PolicyId policy) {
                       return begins_with_name(text.substr(at), manoeuvre::name(policy));
                     });
    if (found != manoeuvre::all_policies.end()) {
      return *found;
    }
  }
  return std::nullopt;
}

std::optional<manoeuvre::PolicyId> concluded(std::string_view reasoning) {
  while (!reasoning.empty()) {
    const std::size_t end = reasoning.rfind('\n');
    const auto named =
        first_named(end == std::string_view::npos ? reasoning : reasoning.substr(end + 1));
    if (named || end == std::string_view::npos) {
      return named;
    }
    reasoning = reasoning.substr(0, end);
  }
  return std::nullopt;
}

}  // namespace saca::language_model

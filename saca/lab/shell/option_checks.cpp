#include "saca/lab/shell/option_checks.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "saca/base/core/other_unit.h"
#include "saca/base/core/suggestion.h"

namespace saca::shell {

CLI::Validator within(double low, double high, std::string_view unit) {
  const bool named = !unit.empty() && unit != "-";
  const std::string shown_unit = named ? fmt::format(" {}", unit) : "";
  const auto complaint = [=, unit = std::string(unit)](const std::string& text) {
    double value = 0.0;
    const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = problem == std::errc() && rest == text.data() + text.size();
    if (number && value >= low && value <= high) {
      return std::string();
    }
    return fmt::format("{}{}: want {:g} to {:g}{}{}", text, number ? shown_unit : "", low, high,
                       shown_unit,
                       number ? other_unit_hint(value, low, high, unit) : ", got no number");
  };
  return {complaint, fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string description = fmt::format("{{{}}}", fmt::join(words, ","));
  const auto complaint = [words = std::move(words)](const std::string& text) {
    return std::find(words.begin(), words.end(), text) != words.end()
               ? std::string()
               : fmt::format("'{}' is unknown; {}", text, suggestion(text, words));
  };
  return {complaint, description};
}

}  // namespace saca::shell

#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace saca::shell {

/// For an option's `check`: a number from `low` to `high`. Unlike CLI::Range it refuses what is no
/// number (nan), which compares false with everything.
/// @param unit  of the number, for the refusal: it asks for another one in which the number would
///              be within the range (core/other_unit.h); empty: none is told
[[nodiscard]] CLI::Validator within(double low, double high, std::string_view unit = "");

/// For an option's `check`: a whole number as an `Integer` holds it, in decimal digits. CLI11
/// itself takes what does not fit, as another number, and digits after a 0 as octal ones.
template <class Integer>
[[nodiscard]] CLI::Validator whole_number() {
  const auto complaint = [](const std::string& text) {
    Integer value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, problem] = std::from_chars(text.data(), end, value);
    return problem == std::errc() && rest == end && text == std::to_string(value)
               ? std::string()
               : fmt::format("want a whole number, {} to {}, got '{}'",
                             std::numeric_limits<Integer>::min(),
                             std::numeric_limits<Integer>::max(), text);
  };
  return {complaint, ""};
}

/// For an option's `check`: one of these words. The refusal tells which was likely meant.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

}  // namespace saca::shell

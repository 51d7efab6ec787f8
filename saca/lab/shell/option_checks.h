#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace saca::shell {

/// For an option's `check`: a number from `low` to `high`. Unlike CLI::Range it refuses what is no
/// number (nan), which compares false with everything.
/// @param unit  of the number, for the refusal: it asks for another one in which the number would
///              be within the range (core/other_unit.h); empty: none is told
[[nodiscard]] CLI::Validator within(double low, double high, std::string_view unit = "");

/// For an option's `check`: one of these words. The refusal tells which was likely meant.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

}  // namespace saca::shell

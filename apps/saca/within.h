#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/onboard/manoeuvre/plan.h"

namespace saca::app {

/// For an option's `check`: a number from `low` to `high`. Unlike CLI::Range it refuses what is no
/// number (nan), which compares false with everything.
/// @param unit  of the number, for the refusal: it asks for another one in which the number would
///              be within the range (core/other_unit.h); empty: none is told
[[nodiscard]] CLI::Validator within(double low, double high, std::string_view unit = "");

/// For an option's `check`: one of these words. The refusal tells which was likely meant.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

/// The option `--threads`.
void add_threads(CLI::App& command, int& threads,
                 const std::string& what = "They do not change the result");

/// The option `--policy`: a number or a short name of the paper, in any case.
CLI::Option* add_policy(CLI::App& command, std::optional<manoeuvre::PolicyId>& policy,
                        const std::string& what);

/// The option `--target-speed` [m/s] that goes with it.
void add_target_speed(CLI::App& command, std::optional<double>& speed);

}  // namespace saca::app

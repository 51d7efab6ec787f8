#pragma once

#include <CLI/CLI.hpp>

namespace saca::app {

/// For an option's `check`: a number from `low` to `high`. Unlike CLI::Range it refuses what is no
/// number (nan), which compares false with everything.
[[nodiscard]] CLI::Validator within(double low, double high);

}  // namespace saca::app

#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "apps/saca/inputs.h"

namespace saca::app {

/// The option `--at-s`: when the policies begin.
void add_at(CLI::App& command, std::optional<double>& at);

/// As asked for, else at the trigger [s]; nullopt: there is none, and that is said.
/// @return  Error::Code::out_of_range: after the scenario's end
[[nodiscard]] Result<std::optional<double>> decision_time(const ScenarioInputs& inputs,
                                                          const std::optional<double>& at);

}  // namespace saca::app

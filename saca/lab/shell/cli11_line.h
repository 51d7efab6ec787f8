#pragma once

#include <CLI/CLI.hpp>

#include "saca/lab/shell/line_description.h"

namespace saca::shell {

/// A command that CLI11 reads, and all below it, in the order in which they were added; hidden ones
/// are left out.
[[nodiscard]] LineDescription described(const CLI::App& command);

/// Why a line that CLI11 refuses cannot be done (refusal.h).
[[nodiscard]] std::string refusal(const CLI::App& line, const CLI::ParseError& problem);

}  // namespace saca::shell

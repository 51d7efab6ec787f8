#pragma once

#include <CLI/CLI.hpp>

#include "saca/lab/shell/line_description.h"

namespace saca::app {

/// The command, and all below it, in the order in which they were added; hidden ones are left out.
[[nodiscard]] shell::LineDescription described(const CLI::App& command);

}  // namespace saca::app

#pragma once

#include <CLI/CLI.hpp>

#include "apps/saca/places.h"

namespace saca::app {

/// Says why what was typed cannot be done: of an unknown command or option, which was likely meant.
/// @return  the exit code that goes with it
[[nodiscard]] ExitCode refuse_line(const CLI::App& line, const CLI::ParseError& problem);

}  // namespace saca::app

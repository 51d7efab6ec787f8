#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/saca/places.h"

namespace saca::app {

/// What was typed, as options are spelt: words joined by `-`, so that `--at_s`, as some options
/// were once spelt, is `--at-s`. Values are as they were typed, and so is what follows `--`.
[[nodiscard]] std::vector<std::string> as_spelt(int argc, const char* const* argv);

/// Says why what was typed cannot be done: of an unknown command or option, which was likely meant.
/// @return  the exit code that goes with it
[[nodiscard]] ExitCode refuse_line(const CLI::App& line, const CLI::ParseError& problem);

/// The commands that are not hidden.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& command);

/// The options that are not hidden, flags among them, but no positional ones.
[[nodiscard]] std::vector<const CLI::Option*> options_of(const CLI::App& command);

/// "saca memory list".
[[nodiscard]] std::string full_name(const CLI::App& command);

}  // namespace saca::app

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "saca/lab/long_work/progress.h"

namespace saca::app {

/// What stands before the command and holds for all of them.
struct Settings {
  bool quiet = false;  ///< neither progress nor story: errors, and what was asked for
  std::string cache;   ///< where tables and atlases are kept; empty: in the user's cache
};

/// This process's; they are set once, while the line is read.
[[nodiscard]] const Settings& settings();

/// What `--quiet` leaves of lines of progress.
[[nodiscard]] long_work::ProgressDisplay progress_display();

/// The options `--quiet` and `--cache`.
void add_settings(CLI::App& line);

/// Whether a standard file understands colours and wants them: it is a terminal, and NO_COLOR is
/// not set (https://no-color.org: to any value but an empty one).
[[nodiscard]] bool wants_colours(int file);

}  // namespace saca::app

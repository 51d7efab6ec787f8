#include "apps/saca/settings.h"

#include <unistd.h>

#include <cstdlib>

namespace saca::app {
namespace {

Settings& the_settings() {
  static Settings settings;
  return settings;
}

}  // namespace

const Settings& settings() {
  return the_settings();
}

long_work::ProgressDisplay progress_display() {
  return settings().quiet ? long_work::ProgressDisplay::silent : long_work::ProgressDisplay::shown;
}

void add_settings(CLI::App& line) {
  line.add_flag("--quiet", the_settings().quiet,
                "Neither progress nor story: only errors, and what was asked for");
  line.add_option("--cache", the_settings().cache,
                  "Folder for tables and atlases (default: $XDG_CACHE_HOME/saca, else "
                  "~/.cache/saca)")
      ->type_name("FOLDER");
}

bool wants_colours(int file) {
  const char* const unwanted = std::getenv("NO_COLOR");
  return (unwanted == nullptr || *unwanted == 0) && ::isatty(file) != 0;
}

}  // namespace saca::app

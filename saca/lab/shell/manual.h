#pragma once

#include <string>
#include <vector>

#include "saca/lab/shell/line_description.h"

namespace saca::shell {

struct ExitCodeMeaning {
  int code = 0;
  std::string meaning;
};

/// What the manual of a program says.
struct Manual {
  std::string version;   ///< "0.1.0"
  LineDescription line;  ///< the whole program, itself first
  std::vector<ExitCodeMeaning> exit_codes;
};

struct ManualPage {
  std::string name;  ///< "saca", "saca-run": of its file without ".1"
  std::string text;  ///< as man(1) reads it
};

/// A text as troff prints it: nothing in it is a command.
[[nodiscard]] std::string troff(std::string_view text);

/// The page of the program, with a list of its commands, exit codes and environment.
[[nodiscard]] ManualPage program_page(const Manual& manual);

/// The page of a command with all commands below it.
/// @param name  its full name, "saca memory"; it is described
[[nodiscard]] ManualPage command_page(const Manual& manual, std::string_view name);

/// The page of the program, and that of each of its commands.
[[nodiscard]] std::vector<ManualPage> manual_pages(const Manual& manual);

}  // namespace saca::shell

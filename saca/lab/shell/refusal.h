#pragma once

#include <string>
#include <vector>

#include "saca/lab/shell/line_description.h"

namespace saca::shell {

/// The words that were typed as options are spelt: joined by `-`, so that `--at_s`, as some options
/// were once spelt, is `--at-s`. Values are as they were typed, and so is what follows `--`.
[[nodiscard]] std::vector<std::string> as_spelt(std::vector<std::string> words);

/// A line that cannot be done.
struct UnusableLine {
  CommandDescription program;
  CommandDescription command;       ///< the innermost that was typed; without any, the program
  std::vector<std::string> left;    ///< words that nothing takes
  bool incomplete_or_left = false;  ///< it is that something is missing, or that words are left
  std::string problem;              ///< what its reader says of it, for all else
};

/// Why: of an unknown command or option, which was likely meant; in the end where help is.
[[nodiscard]] std::string refusal(const UnusableLine& line);

}  // namespace saca::shell

#pragma once

#include <string>

#include "saca/lab/shell/line_description.h"

namespace saca::shell {

// Scripts by which a shell completes what is typed behind `saca`: commands, options, the words that
// an option takes, the names of shipped scenarios (which they ask the program for), files.
//
// `line` describes the whole program.

[[nodiscard]] std::string bash_completion(const LineDescription& line);
[[nodiscard]] std::string zsh_completion(const LineDescription& line);
[[nodiscard]] std::string fish_completion(const LineDescription& line);

}  // namespace saca::shell

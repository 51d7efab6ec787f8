#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace saca::app {

// The commands and options of a line as shells and manual pages need them; hidden ones are left
// out.

struct DescribedOption {
  std::vector<std::string> names;    ///< "--json"; of a positional one its name alone
  std::string value;                 ///< what is to follow, "FOLDER"; empty: nothing
  std::vector<std::string> choices;  ///< of which the value is one; empty: anything
  std::string about;                 ///< one sentence, and the default where there is one
  bool needed = false;
};

struct DescribedCommand {
  std::string name;  ///< "saca memory list"
  std::string about;
  std::vector<DescribedOption> options;
  std::vector<DescribedOption> positionals;
  std::vector<std::string> commands;  ///< their last words
};

/// The command, and all below it, in the order in which they were added.
[[nodiscard]] std::vector<DescribedCommand> described(const CLI::App& command);

}  // namespace saca::app

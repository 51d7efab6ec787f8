#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What a shell and whoever types are told of a command line: completion, manual pages, refusals.
/// All is made of a description of the commands, whatever library reads the line.
namespace saca::shell {

struct OptionDescription {
  std::vector<std::string> names;    ///< "--json"; of a positional one its name alone
  std::string value;                 ///< what is to follow, "FOLDER"; empty: nothing
  std::vector<std::string> choices;  ///< of which the value is one; empty: anything
  std::string about;                 ///< one sentence, and the default where there is one
  bool needed = false;
};

/// Hidden commands and options are left out.
struct CommandDescription {
  std::string name;  ///< "saca memory list"
  std::string about;
  std::vector<OptionDescription> options;
  std::vector<OptionDescription> positionals;
  std::vector<std::string> commands;  ///< their last words
};

/// A command, and all below it, in the order in which they were added.
using LineDescription = std::vector<CommandDescription>;

/// "real" and "lockstep" of the type "TEXT:{real,lockstep}"; of a type without braces nothing.
[[nodiscard]] std::vector<std::string> choices_of(std::string_view type);

/// Tells of an option's value: its name, and in `about` its range and its default.
/// @param type   "FLOAT in [0 - 1]", "TEXT:{real,lockstep}"; empty: the value's name is VALUE
/// @param usual  the default; empty: there is none
void describe_value(OptionDescription& option, const std::string& type, const std::string& usual);

/// The command and all below it.
/// @param name  "saca memory"
[[nodiscard]] LineDescription part_of(const LineDescription& line, std::string_view name);

/// What a command does that may be typed after another.
/// @param name  one of `outer.commands`, and described in `line`
/// @throws ContractViolation  if it is not
[[nodiscard]] const std::string& about(const LineDescription& line, const CommandDescription& outer,
                                       std::string_view name);

}  // namespace saca::shell

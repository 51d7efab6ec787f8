#include "saca/lab/shell/refusal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

#include "saca/base/core/suggestion.h"

namespace saca::shell {
namespace {

std::vector<std::string> spelt_options(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    for (const std::string& name : option.names) {
      if (name.starts_with("--")) {
        names.push_back(name);
      }
    }
  }
  return names;
}

bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && (word[1] == '-' || std::isalpha(word[1]) != 0);
}

/// The option alone: "--at-s" of "--at-s=4".
std::string without_value(const std::string& typed) {
  return typed.substr(0, typed.find('='));
}

/// "memory list: "; empty of the program itself.
std::string place_of(const CommandDescription& command) {
  const auto first = command.name.find(' ');
  return first == std::string::npos ? "" : command.name.substr(first + 1) + ": ";
}

std::string unknown_option(const UnusableLine& line, const std::string& typed) {
  const std::vector<std::string> global = spelt_options(line.program);
  const std::string place = place_of(line.command);
  if (line.command.name != line.program.name &&
      std::find(global.begin(), global.end(), typed) != global.end()) {
    return fmt::format("{}{} stands before the command: saca {} ...", place, typed, typed);
  }
  return fmt::format("{}no option is called {}; {}", place, typed,
                     suggestion(typed, spelt_options(line.command)));
}

std::string unknown_word(const CommandDescription& command, const std::string& typed) {
  return command.commands.empty()
             ? fmt::format("{}want no more arguments, got '{}'", place_of(command), typed)
             : fmt::format("{}no command is called '{}'; {}", place_of(command), typed,
                           suggestion(typed, command.commands));
}

}  // namespace

std::vector<std::string> as_spelt(std::vector<std::string> words) {
  for (std::string& word : words) {
    if (word == "--") {
      break;
    }
    if (word.starts_with("--")) {
      const auto value = std::min(word.find('='), word.size());
      std::replace(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(value), '_', '-');
    }
  }
  return words;
}

std::string refusal(const UnusableLine& line) {
  const std::string help = fmt::format(" (`{} --help`)", line.command.name);
  const auto option = std::find_if(line.left.begin(), line.left.end(), is_option);
  if (line.incomplete_or_left && option != line.left.end()) {
    return unknown_option(line, without_value(*option)) + help;
  }
  if (line.incomplete_or_left && !line.left.empty()) {
    return unknown_word(line.command, line.left.front()) + help;
  }
  if (line.incomplete_or_left && !line.command.commands.empty()) {
    return fmt::format("{}a command is missing; {}{}", place_of(line.command),
                       suggestion("", line.command.commands), help);
  }
  return place_of(line.command) + line.problem + help;
}

}  // namespace saca::shell

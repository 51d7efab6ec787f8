#include "apps/saca/parsing.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "saca/base/core/suggestion.h"

namespace saca::app {
namespace {

const CLI::App& innermost(const CLI::App& line) {
  const auto parsed = line.get_subcommands();
  return parsed.empty() ? line : innermost(*parsed.back());
}

std::vector<std::string> spelt_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : options_of(command)) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

std::vector<std::string> spelt_commands(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* const one : commands_of(command)) {
    names.push_back(one->get_name());
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

/// "memory list: "; empty of the line itself.
std::string place_of(const CLI::App& command) {
  const std::string name = full_name(command);
  const auto first = name.find(' ');
  return first == std::string::npos ? "" : name.substr(first + 1) + ": ";
}

std::string unknown_option(const CLI::App& line, const CLI::App& command,
                           const std::string& typed) {
  const std::vector<std::string> global = spelt_options(line);
  if (&command != &line && std::find(global.begin(), global.end(), typed) != global.end()) {
    return fmt::format("{}{} stands before the command: saca {} ...", place_of(command), typed,
                       typed);
  }
  return fmt::format("{}no option is called {}; {}", place_of(command), typed,
                     suggestion(typed, spelt_options(command)));
}

std::string unknown_word(const CLI::App& command, const std::string& typed) {
  const std::vector<std::string> names = spelt_commands(command);
  return names.empty() ? fmt::format("{}want no more arguments, got '{}'", place_of(command), typed)
                       : fmt::format("{}no command is called '{}'; {}", place_of(command), typed,
                                     suggestion(typed, names));
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
  std::vector<const CLI::App*> all;
  for (const CLI::App* const one : command.get_subcommands({})) {
    if (one->get_name().empty()) {  // a group of options
      continue;
    }
    if (!one->get_group().empty()) {
      all.push_back(one);
    }
  }
  return all;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> all;
  for (const CLI::Option* const option : command.get_options()) {
    if (option->nonpositional() && !option->get_group().empty()) {
      all.push_back(option);
    }
  }
  for (const CLI::App* const group : command.get_subcommands({})) {
    if (group->get_name().empty()) {
      const auto inner = options_of(*group);
      all.insert(all.end(), inner.begin(), inner.end());
    }
  }
  return all;
}

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + " " + command.get_name();
}

std::vector<std::string> as_spelt(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
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

ExitCode refuse_line(const CLI::App& line, const CLI::ParseError& problem) {
  const CLI::App& command = innermost(line);
  const std::string help = fmt::format(" (`{} --help`)", full_name(command));
  const bool may_be_unknown = dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr ||
                              dynamic_cast<const CLI::RequiredError*>(&problem) != nullptr;
  const std::vector<std::string> left = line.remaining(true);
  const auto option = std::find_if(left.begin(), left.end(), is_option);
  if (may_be_unknown && option != left.end()) {
    complain(unknown_option(line, command, without_value(*option)) + help);
  } else if (may_be_unknown && !left.empty()) {
    complain(unknown_word(command, left.front()) + help);
  } else if (may_be_unknown && !commands_of(command).empty()) {
    complain(fmt::format("{}a command is missing; {}{}", place_of(command),
                         suggestion("", spelt_commands(command)), help));
  } else {
    complain(place_of(command) + problem.what() + help);
  }
  return wrong_command_line;
}

}  // namespace saca::app

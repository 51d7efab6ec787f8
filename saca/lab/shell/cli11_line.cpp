#include "saca/lab/shell/cli11_line.h"

#include <utility>

#include "saca/lab/shell/refusal.h"

namespace saca::shell {
namespace {

OptionDescription described_option(const CLI::Option& option) {
  OptionDescription all{.names = {},
                        .value = "",
                        .choices = choices_of(option.get_type_name()),
                        .about = option.get_description(),
                        .needed = option.get_required()};
  if (!option.nonpositional()) {
    all.names.push_back(option.get_name());
    return all;
  }
  for (const std::string& name : option.get_snames()) {
    all.names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    all.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) {
    describe_value(all, option.get_type_name(), option.get_default_str());
  }
  return all;
}

/// Those that are no positional ones, flags among them. A group of options has a flag for help of
/// its own, which is that of its command.
void add_options(const CLI::App& command, std::vector<OptionDescription>& all) {
  for (const CLI::Option* const option : command.get_options()) {
    const bool helps_again = command.get_name().empty() && option == command.get_help_ptr();
    if (option->nonpositional() && !option->get_group().empty() && !helps_again) {
      all.push_back(described_option(*option));
    }
  }
  for (const CLI::App* const group : command.get_subcommands({})) {
    if (group->get_name().empty()) {
      add_options(*group, all);
    }
  }
}

void add_positionals(const CLI::App& command, std::vector<OptionDescription>& all) {
  for (const CLI::Option* const option : command.get_options()) {
    if (!option->nonpositional() && !option->get_group().empty()) {
      all.push_back(described_option(*option));
    }
  }
}

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + " " + command.get_name();
}

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
  std::vector<const CLI::App*> all;
  for (const CLI::App* const one : command.get_subcommands({})) {
    const bool group_of_options = one->get_name().empty();
    if (!group_of_options && !one->get_group().empty()) {
      all.push_back(one);
    }
  }
  return all;
}

void add(const CLI::App& command, LineDescription& all) {
  CommandDescription one{.name = full_name(command),
                         .about = command.get_description(),
                         .options = {},
                         .positionals = {},
                         .commands = {}};
  add_options(command, one.options);
  add_positionals(command, one.positionals);
  const auto inner = commands_of(command);
  for (const CLI::App* const next : inner) {
    one.commands.push_back(next->get_name());
  }
  all.push_back(std::move(one));
  for (const CLI::App* const next : inner) {
    add(*next, all);
  }
}

}  // namespace

LineDescription described(const CLI::App& command) {
  LineDescription all;
  add(command, all);
  return all;
}

namespace {

const CLI::App& innermost(const CLI::App& line) {
  const auto parsed = line.get_subcommands();
  return parsed.empty() ? line : innermost(*parsed.back());
}

}  // namespace

std::string refusal(const CLI::App& line, const CLI::ParseError& problem) {
  return refusal(
      {.program = described(line).front(),
       .command = described(innermost(line)).front(),
       .left = line.remaining(true),
       .incomplete_or_left = dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr ||
                             dynamic_cast<const CLI::RequiredError*>(&problem) != nullptr,
       .problem = problem.what()});
}

}  // namespace saca::shell

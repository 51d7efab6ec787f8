#include "apps/saca/line_description.h"

#include <string_view>

#include "apps/saca/parsing.h"
#include "saca/base/core/csv.h"

namespace saca::app {
namespace {

/// "real", "lockstep" of "TEXT:{real,lockstep}".
std::vector<std::string> choices_of(std::string_view type) {
  const auto open = type.find('{');
  const auto close = type.rfind('}');
  if (open == type.npos || close == type.npos || close < open) {
    return {};
  }
  const auto words = fields_of(type.substr(open + 1, close - open - 1), ',');
  return {words.begin(), words.end()};
}

DescribedOption described_option(const CLI::Option& option) {
  DescribedOption all{.names = {},
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
    const std::string type = option.get_type_name();
    all.value = type.substr(0, type.find(':'));
    const auto range = all.value.find(" in [");  // of numbers
    all.about += range == std::string::npos ? "" : " (" + all.value.substr(range + 1) + ")";
    all.value = all.value.substr(0, range);
    all.value = all.value.empty() ? "VALUE" : all.value;
    if (const std::string usual = option.get_default_str(); !usual.empty()) {
      all.about += " (default: " + usual + ")";
    }
  }
  return all;
}

void add_positionals(const CLI::App& command, std::vector<DescribedOption>& all) {
  for (const CLI::Option* const option : command.get_options()) {
    if (!option->nonpositional() && !option->get_group().empty()) {
      all.push_back(described_option(*option));
    }
  }
}

void add(const CLI::App& command, std::vector<DescribedCommand>& all) {
  DescribedCommand one{.name = full_name(command),
                       .about = command.get_description(),
                       .options = {},
                       .positionals = {},
                       .commands = {}};
  for (const CLI::Option* const option : options_of(command)) {
    one.options.push_back(described_option(*option));
  }
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

std::vector<DescribedCommand> described(const CLI::App& command) {
  std::vector<DescribedCommand> all;
  add(command, all);
  return all;
}

}  // namespace saca::app

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/invocation.h"
#include "apps/saca/line_description.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

using Commands = std::vector<DescribedCommand>;

/// Of the commands' names, those with more than one word: what may be typed after another word.
std::vector<std::string> longer_names(const Commands& commands) {
  std::vector<std::string> names;
  for (const DescribedCommand& one : commands) {
    if (one.name.find(' ') != std::string::npos) {
      names.push_back("\"" + one.name + "\"");
    }
  }
  return names;
}

std::vector<std::string> option_names(const DescribedCommand& command) {
  std::vector<std::string> names;
  for (const DescribedOption& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

/// What a command does that may be typed after another.
const std::string& about(const Commands& commands, const DescribedCommand& outer,
                         const std::string& name) {
  return std::find_if(commands.begin(), commands.end(),
                      [&](const auto& each) { return each.name == outer.name + " " + name; })
      ->about;
}

/// "saca run --pace" and so on, for each name of an option.
std::vector<std::string> option_places(const DescribedCommand& command,
                                       const DescribedOption& option) {
  std::vector<std::string> places;
  for (const std::string& name : option.names) {
    places.push_back("\"" + command.name + " " + name + "\"");
  }
  return places;
}

/// What of the first positional argument can be told: words, or the names of shipped scenarios.
std::vector<std::string> first_words(const DescribedCommand& command) {
  return command.positionals.empty() ? std::vector<std::string>()
                                     : command.positionals.front().choices;
}

bool wants_scenario(const DescribedCommand& command) {
  return !command.positionals.empty() && (command.positionals.front().names.front() == "scenario" ||
                                          command.positionals.front().names.front() == "scenarios");
}

constexpr std::string_view scenario_names =
    "(saca scenarios 2>/dev/null | cut -d\" \" -f1)";  // asked for only when it is needed

std::string bash(const Commands& commands) {
  std::string values;
  std::string words;
  for (const DescribedCommand& one : commands) {
    for (const DescribedOption& option : one.options) {
      if (option.value.empty()) {
        continue;
      }
      values += fmt::format(
          "    {})\n      COMPREPLY=($(compgen {} -- \"$word\")); return ;;\n",
          fmt::join(option_places(one, option), "|"),
          option.choices.empty() ? "-f" : fmt::format("-W \"{}\"", fmt::join(option.choices, " ")));
    }
    std::vector<std::string> other = one.commands;
    const auto first = first_words(one);
    other.insert(other.end(), first.begin(), first.end());
    words += fmt::format("    \"{}\")\n      options=\"{}\"\n      words=\"{}{}\" ;;\n", one.name,
                         fmt::join(option_names(one), " "), fmt::join(other, " "),
                         wants_scenario(one) ? fmt::format("${}", scenario_names) : "");
  }
  return fmt::format(R"(# bash completion of saca, made by `saca completion bash`
_saca() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" command="saca" options="" words="" i
  COMPREPLY=()
  if [[ $word == "=" ]]; then
    word=""
  elif [[ $before == "=" ]]; then
    before="${{COMP_WORDS[COMP_CWORD-2]}}"
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$command ${{COMP_WORDS[i]}}" in
      {})
        command="$command ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$command $before" in
{}  esac
  case "$command" in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
    return
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  if [[ ${{#COMPREPLY[@]}} -eq 0 ]]; then
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _saca saca
)",
                     fmt::join(longer_names(commands), "|"), values, words);
}

/// "name:what it does", as _describe of zsh takes it.
std::string described_word(const std::string& name, std::string_view about) {
  std::string text = name;
  for (std::size_t at = 0; (at = text.find(':', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return in_quotes(text + ":" + std::string(about));
}

std::string zsh(const Commands& commands) {
  std::string values;
  std::string words;
  for (const DescribedCommand& one : commands) {
    std::string options;
    for (const DescribedOption& option : one.options) {
      for (const std::string& name : option.names) {
        options += " " + described_word(name, option.about);
      }
      if (!option.value.empty()) {
        values += fmt::format(
            "    ({})\n      {}; return ;;\n", fmt::join(option_places(one, option), "|"),
            option.choices.empty() ? "_files"
                                   : fmt::format("compadd -- {}", fmt::join(option.choices, " ")));
      }
    }
    std::string inner;
    for (const std::string& name : one.commands) {
      inner += " " + described_word(name, about(commands, one, name));
    }
    for (const std::string& word : first_words(one)) {
      inner += " " + in_quotes(word);
    }
    words += fmt::format("    (\"{}\")\n      options=({} )\n      words_there=({} {}) ;;\n",
                         one.name, options, inner,
                         wants_scenario(one) ? fmt::format("${{(f)\"${}\"}}", scenario_names) : "");
  }
  return fmt::format(R"(#compdef saca
# zsh completion of saca, made by `saca completion zsh`
_saca() {{
  local command="saca" i
  local -a options words_there
  for ((i = 2; i < CURRENT; i++)); do
    case "$command $words[i]" in
      ({})
        command="$command $words[i]" ;;
    esac
  done
  case "$command $words[CURRENT-1]" in
{}  esac
  case "$command" in
{}  esac
  if [[ "$words[CURRENT]" == -* ]]; then
    _describe option options
  else
    (( $#words_there )) && _describe word words_there
    _files
  fi
}}
_saca "$@"
)",
                     fmt::join(longer_names(commands), "|"), values, words);
}

std::string fish(const Commands& commands) {
  std::string lines;
  for (const DescribedCommand& one : commands) {
    const std::string here =
        fmt::format("complete -c saca -n 'test (__saca_command) = \"{}\"'", one.name);
    for (const std::string& name : one.commands) {
      lines +=
          fmt::format("{} -f -a {} -d {}\n", here, name, in_quotes(about(commands, one, name)));
    }
    if (!first_words(one).empty()) {
      lines += fmt::format("{} -f -a '{}'\n", here, fmt::join(first_words(one), " "));
    }
    if (wants_scenario(one)) {
      lines += fmt::format("{} -a '{}'\n", here, scenario_names);
    }
    for (const DescribedOption& option : one.options) {
      lines += here;
      for (const std::string& name : option.names) {
        lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      lines += option.value.empty() ? ""
               : option.choices.empty()
                   ? " -r"
                   : fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
      lines += " -d " + in_quotes(option.about) + "\n";
    }
  }
  return fmt::format(R"(# fish completion of saca, made by `saca completion fish`
function __saca_command
    set -l command saca
    set -l typed (commandline -opc)
    for word in $typed[2..-1]
        switch "$command $word"
            case {}
                set command "$command $word"
        end
    end
    echo $command
end
{})",
                     fmt::join(longer_names(commands), " "), lines);
}

struct CompletionOptions {
  std::string shell;
  std::string output;
};

int complete(const CLI::App& line, const CompletionOptions& options) {
  const Commands commands = described(line);
  const std::string text = options.shell == "bash"  ? bash(commands)
                           : options.shell == "zsh" ? zsh(commands)
                                                    : fish(commands);
  if (options.output.empty()) {
    app::print("{}", text);
    return success;
  }
  const auto problem = long_work::write_output(options.output, text);
  return problem ? refused(*problem) : success;
}

}  // namespace

void add_completion(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("completion", "What a shell needs to complete what is typed");
  command->group("");  // whoever packs the program calls it
  const auto options = std::make_shared<CompletionOptions>();
  command->add_option("shell", options->shell, "bash, zsh or fish")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  command->add_option("--output", options->output, "A file; default: standard output");
  command->callback([&line, options, &exit_code] { exit_code = complete(line, *options); });
}

}  // namespace saca::app

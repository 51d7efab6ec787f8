#include "saca/lab/shell/completion.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <string_view>
#include <vector>

#include "saca/lab/shell/quotes.h"

namespace saca::shell {
namespace {

/// Of the commands' names, those with more than one word: what may be typed after another word.
std::vector<std::string> longer_names(const LineDescription& line) {
  std::vector<std::string> names;
  for (const CommandDescription& one : line) {
    if (one.name.find(' ') != std::string::npos) {
      names.push_back("\"" + one.name + "\"");
    }
  }
  return names;
}

std::vector<std::string> option_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

/// "saca run --pace" and so on, for each name of an option.
std::vector<std::string> option_places(const CommandDescription& command,
                                       const OptionDescription& option) {
  std::vector<std::string> places;
  for (const std::string& name : option.names) {
    places.push_back("\"" + command.name + " " + name + "\"");
  }
  return places;
}

/// What of the first positional argument can be told: words, or the names of shipped scenarios.
std::vector<std::string> first_words(const CommandDescription& command) {
  return command.positionals.empty() ? std::vector<std::string>()
                                     : command.positionals.front().choices;
}

bool wants_scenario(const CommandDescription& command) {
  return !command.positionals.empty() && (command.positionals.front().names.front() == "scenario" ||
                                          command.positionals.front().names.front() == "scenarios");
}

constexpr std::string_view scenario_names =
    "(saca scenarios 2>/dev/null | cut -d\" \" -f1)";  // asked for only when it is needed

/// Of a script's two choices: what follows an option, and what follows a command.
struct Branches {
  std::string values;
  std::string words;
};

Branches bash_branches(const LineDescription& line) {
  Branches branches;
  for (const CommandDescription& one : line) {
    for (const OptionDescription& option : one.options) {
      if (option.value.empty()) {
        continue;
      }
      branches.values += fmt::format(
          "    {})\n      COMPREPLY=($(compgen {} -- \"$word\")); return ;;\n",
          fmt::join(option_places(one, option), "|"),
          option.choices.empty() ? "-f" : fmt::format("-W \"{}\"", fmt::join(option.choices, " ")));
    }
    std::vector<std::string> other = one.commands;
    const auto first = first_words(one);
    other.insert(other.end(), first.begin(), first.end());
    branches.words +=
        fmt::format("    \"{}\")\n      options=\"{}\"\n      words=\"{}{}\" ;;\n", one.name,
                    fmt::join(option_names(one), " "), fmt::join(other, " "),
                    wants_scenario(one) ? fmt::format("${}", scenario_names) : "");
  }
  return branches;
}

/// "name:what it does", as _describe of zsh takes it.
std::string described_word(const std::string& name, std::string_view what) {
  std::string text = name;
  for (std::size_t at = 0; (at = text.find(':', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return in_quotes(text + ":" + std::string(what));
}

Branches zsh_branches(const LineDescription& line) {
  Branches branches;
  for (const CommandDescription& one : line) {
    std::string options;
    for (const OptionDescription& option : one.options) {
      for (const std::string& name : option.names) {
        options += " " + described_word(name, option.about);
      }
      if (!option.value.empty()) {
        branches.values += fmt::format(
            "    ({})\n      {}; return ;;\n", fmt::join(option_places(one, option), "|"),
            option.choices.empty() ? "_files"
                                   : fmt::format("compadd -- {}", fmt::join(option.choices, " ")));
      }
    }
    std::string inner;
    for (const std::string& name : one.commands) {
      inner += " " + described_word(name, about(line, one, name));
    }
    for (const std::string& word : first_words(one)) {
      inner += " " + in_quotes(word);
    }
    branches.words += fmt::format(
        "    (\"{}\")\n      options=({} )\n      words_there=({} {}) ;;\n", one.name, options,
        inner, wants_scenario(one) ? fmt::format("${{(f)\"${}\"}}", scenario_names) : "");
  }
  return branches;
}

/// A line for fish: what may be typed as an option of a command.
std::string fish_option(const OptionDescription& option) {
  std::string text;
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  text += option.value.empty()     ? ""
          : option.choices.empty() ? " -r"
                                   : fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  return text + " -d " + in_quotes(option.about) + "\n";
}

std::string fish_lines(const LineDescription& line) {
  std::string lines;
  for (const CommandDescription& one : line) {
    const std::string here =
        fmt::format("complete -c saca -n 'test (__saca_command) = \"{}\"'", one.name);
    for (const std::string& name : one.commands) {
      lines += fmt::format("{} -f -a {} -d {}\n", here, name, in_quotes(about(line, one, name)));
    }
    if (!first_words(one).empty()) {
      lines += fmt::format("{} -f -a '{}'\n", here, fmt::join(first_words(one), " "));
    }
    if (wants_scenario(one)) {
      lines += fmt::format("{} -a '{}'\n", here, scenario_names);
    }
    for (const OptionDescription& option : one.options) {
      lines += here + fish_option(option);
    }
  }
  return lines;
}

}  // namespace

std::string bash_completion(const LineDescription& line) {
  const Branches branches = bash_branches(line);
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
                     fmt::join(longer_names(line), "|"), branches.values, branches.words);
}

std::string zsh_completion(const LineDescription& line) {
  const Branches branches = zsh_branches(line);
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
                     fmt::join(longer_names(line), "|"), branches.values, branches.words);
}

std::string fish_completion(const LineDescription& line) {
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
                     fmt::join(longer_names(line), " "), fish_lines(line));
}

}  // namespace saca::shell

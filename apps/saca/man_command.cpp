#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/line_description.h"
#include "apps/saca/parsing.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct CodeMeaning {
  ExitCode code;
  const char* meaning;
};
constexpr std::array code_meanings{
    CodeMeaning{success, "done"},
    CodeMeaning{internal_error, "internal error: please report it"},
    CodeMeaning{wrong_command_line, "wrong command line"},
    CodeMeaning{bad_input, "an input cannot be used; the message names file, line and key"},
    CodeMeaning{cannot_write, "an output cannot be written; nothing half-written is left"},
    CodeMeaning{some_failed, "done, but some of many encounters or tests could not be played"},
    CodeMeaning{not_the_same, "something came out otherwise than it was recorded"},
    CodeMeaning{nothing_to_decide, "nothing threatens, so nothing is to be decided"},
    CodeMeaning{too_slow, "the machine or the model did not answer in the time that there was"},
    CodeMeaning{was_interrupted, "interrupted"}};

/// A text as troff prints it: nothing in it is a command.
std::string troff(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    const bool begins_line = out.empty() || out.back() == '\n';
    out += begins_line && (letter == '.' || letter == '\'') ? "\\&" : "";
    out += letter == '\\' ? "\\e" : letter == '-' ? "\\-" : std::string(1, letter);
  }
  return out;
}

std::string entry(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + (text.empty() ? "\\&" : text) + "\n";
}

/// "\-\-pace real|lockstep", the words in their types.
std::string option_head(const DescribedOption& option, bool positional) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back((positional ? "\\fI" : "\\fB") + troff(name) + "\\fR");
  }
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.value.empty()) {
    head += " \\fI" + troff(option.value) + "\\fR";
  }
  return head;
}

std::string option_text(const DescribedOption& option) {
  std::string text = option.about;
  if (!option.choices.empty()) {
    text += fmt::format("{}One of: {}.", text.empty() ? "" : ". ", fmt::join(option.choices, ", "));
  }
  if (option.needed) {
    text += text.empty() ? "Needed." : " (needed)";
  }
  return troff(text);
}

std::string synopsis(const DescribedCommand& command) {
  std::string text = "\\fB" + troff(command.name) + "\\fR";
  text += command.options.empty() ? "" : " [\\fIOPTION\\fR]...";
  for (const DescribedOption& one : command.positionals) {
    text += one.needed ? " \\fI" + troff(one.names.front()) + "\\fR"
                       : " [\\fI" + troff(one.names.front()) + "\\fR]";
  }
  text += command.commands.empty() ? "" : " \\fICOMMAND\\fR ...";
  return text + "\n";
}

std::string arguments(const DescribedCommand& command) {
  std::string text;
  for (const DescribedOption& one : command.positionals) {
    text += entry(option_head(one, true), option_text(one));
  }
  for (const DescribedOption& one : command.options) {
    text += entry(option_head(one, false), option_text(one));
  }
  return text;
}

std::string page_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// The page of a command with all commands below it; of the line with a list of them.
std::string page(const CLI::App& line, const CLI::App& command) {
  const bool whole = &line == &command;
  const std::vector<DescribedCommand> all = described(command);
  const DescribedCommand& own = all.front();
  const std::string name = page_name(own.name);
  std::string capitals = name;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  std::string text =
      fmt::format(".\\\" Made by `saca man`.\n.TH {} 1 \"\" \"saca {}\" \"SACA\"\n.ad l\n",
                  troff(capitals), SACA_VERSION);
  text += ".SH NAME\n" + troff(name) + " \\- " + troff(own.about) + "\n";
  text += ".SH SYNOPSIS\n" + synopsis(own);
  for (const DescribedCommand& one : all) {
    if (!whole && &one != &own) {
      text += ".br\n" + synopsis(one);
    }
  }
  text += ".SH OPTIONS\n" + arguments(own);
  if (whole) {
    text += ".SH COMMANDS\n";
    for (const CLI::App* const one : commands_of(command)) {
      text += entry("\\fB" + troff(one->get_name()) + "\\fR", troff(one->get_description()));
    }
    text += ".SH EXIT STATUS\n";
    for (const CodeMeaning& one : code_meanings) {
      text += entry(fmt::format("\\fB{}\\fR", static_cast<int>(one.code)), troff(one.meaning));
    }
    text += ".SH ENVIRONMENT\n" +
            entry("\\fBXDG_CACHE_HOME\\fR",
                  troff("Tables and atlases are kept in its folder saca, else in ~/.cache/saca; "
                        "--cache says otherwise.")) +
            entry("\\fBNO_COLOR\\fR", "Set to anything: no colours, on a terminal neither.") +
            entry("\\fBSACA_LLM_KEY\\fR", "Key of the server that \\fB\\-\\-llm\\fR names.");
  } else {
    for (const DescribedCommand& one : all) {
      if (&one != &own) {
        text += ".SH \"" + troff(one.name) + "\"\n" + troff(one.about) + "\n" + arguments(one);
      }
    }
    text += ".SH SEE ALSO\n\\fBsaca\\fR(1) for exit status and environment\n";
  }
  return text;
}

struct ManOptions {
  std::string command;
  std::string folder;
};

/// All pages, as files of a folder.
std::optional<Error> write_all(const CLI::App& line, const fs::path& folder) {
  const auto write = [&](const CLI::App& command) {
    return long_work::write_output(folder / (page_name(full_name(command)) + ".1"),
                                   page(line, command));
  };
  auto problem = write(line);
  for (const CLI::App* const one : commands_of(line)) {
    if (!problem) {
      problem = write(*one);
    }
  }
  return problem;
}

int man(const CLI::App& line, const ManOptions& options) {
  if (!options.folder.empty()) {
    const auto problem = write_all(line, options.folder);
    return problem ? refused(*problem) : success;
  }
  std::vector<std::string> names;
  for (const CLI::App* const one : commands_of(line)) {
    if (one->get_name() == options.command) {
      app::print("{}", page(line, *one));
      return success;
    }
    names.push_back(one->get_name());
  }
  if (!options.command.empty()) {
    complain(fmt::format("man: no command is called '{}'; {}", options.command,
                         suggestion(options.command, names)));
    return wrong_command_line;
  }
  app::print("{}", page(line, line));
  return success;
}

}  // namespace

void add_man(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("man", "A manual page, as man(1) reads it");
  command->group("");  // whoever packs the program calls it
  const auto options = std::make_shared<ManOptions>();
  command->add_option("command", options->command, "Whose; default: of the program");
  command->add_option("--all", options->folder, "A folder: write all pages there");
  command->callback([&line, options, &exit_code] { exit_code = man(line, *options); });
}

}  // namespace saca::app

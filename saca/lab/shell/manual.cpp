#include "saca/lab/shell/manual.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "saca/base/core/contract.h"

namespace saca::shell {
namespace {

std::string entry(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + (text.empty() ? "\\&" : text) + "\n";
}

enum class OptionKind { named, positional };

/// "\-\-pace real|lockstep", the words in their types.
std::string option_head(const OptionDescription& option, OptionKind kind) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back((kind == OptionKind::positional ? "\\fI" : "\\fB") + troff(name) + "\\fR");
  }
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.value.empty()) {
    head += " \\fI" + troff(option.value) + "\\fR";
  }
  return head;
}

std::string option_text(const OptionDescription& option) {
  std::string text = option.about;
  if (!option.choices.empty()) {
    text += fmt::format("{}One of: {}.", text.empty() ? "" : ". ", fmt::join(option.choices, ", "));
  }
  if (option.needed) {
    text += text.empty() ? "Needed." : " (needed)";
  }
  return troff(text);
}

std::string synopsis(const CommandDescription& command) {
  std::string text = "\\fB" + troff(command.name) + "\\fR";
  text += command.options.empty() ? "" : " [\\fIOPTION\\fR]...";
  for (const OptionDescription& one : command.positionals) {
    text += one.needed ? " \\fI" + troff(one.names.front()) + "\\fR"
                       : " [\\fI" + troff(one.names.front()) + "\\fR]";
  }
  text += command.commands.empty() ? "" : " \\fICOMMAND\\fR ...";
  return text + "\n";
}

std::string arguments(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& one : command.positionals) {
    text += entry(option_head(one, OptionKind::positional), option_text(one));
  }
  for (const OptionDescription& one : command.options) {
    text += entry(option_head(one, OptionKind::named), option_text(one));
  }
  return text;
}

std::string page_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// Title and name of a command's page, up to where its synopsis stands.
std::string beginning(const Manual& manual, const CommandDescription& own) {
  const std::string name = page_name(own.name);
  std::string capitals = name;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return fmt::format(".\\\" Made by `saca man`.\n.TH {} 1 \"\" \"saca {}\" \"SACA\"\n.ad l\n",
                     troff(capitals), manual.version) +
         ".SH NAME\n" + troff(name) + " \\- " + troff(own.about) + "\n" + ".SH SYNOPSIS\n" +
         synopsis(own);
}

std::string environment() {
  return ".SH ENVIRONMENT\n" +
         entry("\\fBXDG_CACHE_HOME\\fR",
               troff("Tables and atlases are kept in its folder saca, else in ~/.cache/saca; "
                     "--cache says otherwise.")) +
         entry("\\fBNO_COLOR\\fR", "Set to anything: no colours, on a terminal neither.") +
         entry("\\fBSACA_LLM_KEY\\fR", "Key of the server that \\fB\\-\\-llm\\fR names.");
}

}  // namespace

std::string troff(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    const bool begins_line = out.empty() || out.back() == '\n';
    out += begins_line && (letter == '.' || letter == '\'') ? "\\&" : "";
    out += letter == '\\' ? "\\e" : letter == '-' ? "\\-" : std::string(1, letter);
  }
  return out;
}

ManualPage program_page(const Manual& manual) {
  expects(!manual.line.empty(), "a program that is described");
  const CommandDescription& own = manual.line.front();
  std::string text = beginning(manual, own) + ".SH OPTIONS\n" + arguments(own) + ".SH COMMANDS\n";
  for (const std::string& one : own.commands) {
    text += entry("\\fB" + troff(one) + "\\fR", troff(about(manual.line, own, one)));
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitCodeMeaning& one : manual.exit_codes) {
    text += entry(fmt::format("\\fB{}\\fR", one.code), troff(one.meaning));
  }
  return {.name = page_name(own.name), .text = text + environment()};
}

ManualPage command_page(const Manual& manual, std::string_view name) {
  const LineDescription all = part_of(manual.line, name);
  expects(!all.empty(), "a command that is described");
  const CommandDescription& own = all.front();
  std::string text = beginning(manual, own);
  for (std::size_t i = 1; i < all.size(); ++i) {
    text += ".br\n" + synopsis(all[i]);
  }
  text += ".SH OPTIONS\n" + arguments(own);
  for (std::size_t i = 1; i < all.size(); ++i) {
    text += ".SH \"" + troff(all[i].name) + "\"\n" + troff(all[i].about) + "\n" + arguments(all[i]);
  }
  text += ".SH SEE ALSO\n\\fBsaca\\fR(1) for exit status and environment\n";
  return {.name = page_name(own.name), .text = text};
}

std::vector<ManualPage> manual_pages(const Manual& manual) {
  std::vector<ManualPage> pages{program_page(manual)};
  const CommandDescription& own = manual.line.front();
  for (const std::string& one : own.commands) {
    pages.push_back(command_page(manual, own.name + " " + one));
  }
  return pages;
}

}  // namespace saca::shell

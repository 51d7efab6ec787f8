#include <algorithm>

#include "apps/saca/options.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/shell/cli11_line.h"
#include "saca/lab/shell/completion.h"
#include "saca/lab/shell/manual.h"

namespace saca::app {
namespace {

struct CompletionOptions {
  std::string shell;
  std::string output;
  const CLI::App* line = nullptr;  ///< that is described
};

void complete(const CompletionOptions& options) {
  const shell::LineDescription commands = shell::described(*options.line);
  const std::string text = options.shell == "bash"  ? shell::bash_completion(commands)
                           : options.shell == "zsh" ? shell::zsh_completion(commands)
                                                    : shell::fish_completion(commands);
  if (options.output.empty()) {
    app::print("{}", text);
  } else {
    write(options.output, text);
  }
}

struct ManOptions {
  std::string command;
  std::string folder;
  const CLI::App* line = nullptr;  ///< that is described
};

shell::Manual manual_of(const CLI::App& line) {
  return {.version = SACA_VERSION,
          .line = shell::described(line),
          .exit_codes = {
              {success, "done"},
              {internal_error, "internal error: please report it"},
              {wrong_command_line, "wrong command line"},
              {bad_input, "an input cannot be used; the message names file, line and key"},
              {cannot_write, "an output cannot be written; nothing half-written is left"},
              {some_failed, "done, but some of many encounters or tests could not be played"},
              {not_the_same, "something came out otherwise than it was recorded"},
              {nothing_to_decide, "nothing threatens, so nothing is to be decided"},
              {too_slow, "the machine or the model did not answer in the time that there was"},
              {was_interrupted, "interrupted"}}};
}

void tell_manual(const ManOptions& options) {
  const shell::Manual manual = manual_of(*options.line);
  if (!options.folder.empty()) {
    for (const shell::ManualPage& page : shell::manual_pages(manual)) {
      write(fs::path(options.folder) / (page.name + ".1"), page.text);
    }
    return;
  }
  const auto& names = manual.line.front().commands;
  if (options.command.empty()) {
    app::print("{}", shell::program_page(manual).text);
  } else if (std::find(names.begin(), names.end(), options.command) != names.end()) {
    app::print("{}", shell::command_page(manual, "saca " + options.command).text);
  } else {
    refuse(wrong_command_line, fmt::format("man: no command is called '{}'; {}", options.command,
                                           suggestion(options.command, names)));
  }
}

}  // namespace

void add_shell_files(CLI::App& line) {
  const auto completion = add_command<CompletionOptions>(
      line, "completion", "What a shell needs to complete what is typed", complete);
  completion.options.line = &line;
  completion.line.group("");  // whoever packs the program calls it
  add_needed(completion.line, "shell", completion.options.shell, "bash, zsh or fish",
             one_of({"bash", "zsh", "fish"}));
  add(completion.line, "--output", completion.options.output, "A file; default: standard output");

  const auto [man, options] =
      add_command<ManOptions>(line, "man", "A manual page, as man(1) reads it", tell_manual);
  options.line = &line;
  man.group("");  // likewise
  add(man, "command", options.command, "Whose; default: of the program");
  add(man, "--all", options.folder, "A folder: write all pages there");
}

}  // namespace saca::app

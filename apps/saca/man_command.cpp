#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/line_description.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/suggestion.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/shell/manual.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct ManOptions {
  std::string command;
  std::string folder;
};

shell::Manual manual_of(const CLI::App& line) {
  return {.version = SACA_VERSION,
          .line = described(line),
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

int write_pages(const shell::Manual& manual, const fs::path& folder) {
  for (const shell::ManualPage& page : shell::manual_pages(manual)) {
    if (const auto problem = long_work::write_output(folder / (page.name + ".1"), page.text)) {
      return refused(*problem);
    }
  }
  return success;
}

int man(const CLI::App& line, const ManOptions& options) {
  const shell::Manual manual = manual_of(line);
  if (!options.folder.empty()) {
    return write_pages(manual, options.folder);
  }
  const auto& names = manual.line.front().commands;
  if (std::find(names.begin(), names.end(), options.command) != names.end()) {
    app::print("{}", shell::command_page(manual, "saca " + options.command).text);
    return success;
  }
  if (!options.command.empty()) {
    complain(fmt::format("man: no command is called '{}'; {}", options.command,
                         suggestion(options.command, names)));
    return wrong_command_line;
  }
  app::print("{}", shell::program_page(manual).text);
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

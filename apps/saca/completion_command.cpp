#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/line_description.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/shell/completion.h"

namespace saca::app {
namespace {

struct CompletionOptions {
  std::string shell;
  std::string output;
};

int complete(const CLI::App& line, const CompletionOptions& options) {
  const shell::LineDescription commands = described(line);
  const std::string text = options.shell == "bash"  ? shell::bash_completion(commands)
                           : options.shell == "zsh" ? shell::zsh_completion(commands)
                                                    : shell::fish_completion(commands);
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

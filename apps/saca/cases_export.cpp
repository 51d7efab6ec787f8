#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "apps/saca/cases_commands.h"
#include "apps/saca/example_options.h"
#include "apps/saca/figures_output.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/cases/example_sets.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::app {
namespace {

struct CasesExportOptions {
  cases::ExampleOptions examples;
  std::string format = "local";
  std::string output = "runs/reply_sets";
  int threads = usual_threads();
  bool as_json = false;
};

int export_cases(const CasesExportOptions& options) {
  const std::filesystem::path folder = options.output;
  if (const auto problem = long_work::why_outputs_unwritable({folder / "train.jsonl"})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const auto opened = open_examples(options.examples);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  const cases::ExampleSource& source = opened.value().source;
  auto gathered = cases::all_examples(
      source, {.journal = (folder / "journal").string(),
               .title = fmt::format("saca {} cases export --car {} --seed {}", version_text(),
                                    options.examples.car, options.examples.seed),
               .display = progress_display(),
               .threads = options.threads,
               .words = options.examples.seed});
  if (!gathered.has_value()) {
    return refused(gathered.error());
  }
  if (!gathered.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  const auto [examples, problems] = *std::move(gathered).value();
  complain_of(problems);
  const cases::SetTallies tallies = cases::set_tallies(examples);
  const std::string command = fmt::format("cases export {} --format {} {}", options.examples.file,
                                          options.format, cases::example_text(options.examples));
  if (const auto problem =
          cases::write_sets(folder, examples, cases::set_format_from(options.format).value(),
                            language_model::system_part(opened.value().planes->inputs.harm),
                            cases::data_card(source, tallies, command, SACA_VERSION))) {
    return refused(*problem);
  }
  if (options.as_json) {
    print_with_meta(cases::sets_json(source, tallies, problems.size()), command);
  } else {
    app::print("{}", cases::sets_text(source, tallies, options.output));
  }
  return problems.empty() ? success : some_failed;
}

}  // namespace

void add_cases_export(CLI::App& cases, int& exit_code) {
  CLI::App* const command = cases.add_subcommand(
      "export", "Writes prompts and an expert's replies as sets to teach a language model with");
  const auto options = std::make_shared<CasesExportOptions>();
  add_example_options(*command, options->examples);
  command
      ->add_option("--format", options->format,
                   "local: with what is known of each, for `training/`; openai: chat fine-tuning")
      ->check(CLI::IsMember({"local", "openai"}))
      ->capture_default_str();
  command->add_option("--output,-o", options->output, "The folder where the sets go")
      ->capture_default_str();
  add_threads(*command, options->threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = export_cases(*options); });
}

}  // namespace saca::app

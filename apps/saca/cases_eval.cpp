#include <fmt/core.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/example_options.h"
#include "apps/saca/figures_output.h"
#include "apps/saca/model.h"
#include "apps/saca/settings.h"
#include "saca/lab/cases/model_replies.h"
#include "saca/lab/cases/reply_report.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct CasesEvalOptions {
  cases::ExampleOptions examples;
  std::string model = "local";
  std::string set = "test";
  std::size_t count = 0;  ///< at most so many cases; 0: all of the set
  std::string output = "runs/replies.jsonl";
  bool unconstrained = false;
  bool as_json = false;
};

std::string command_of(const CasesEvalOptions& options) {
  return fmt::format("cases eval {} --set {}{} --llm {} {}", options.examples.file, options.set,
                     options.count > 0 ? fmt::format(" --count {}", options.count) : "",
                     options.model + (options.unconstrained ? " --unconstrained" : ""),
                     cases::example_text(options.examples));
}

/// Tells the score, and what could not be asked.
int tell_replies(const std::vector<cases::ExampleReply>& replies, std::size_t failed,
                 const CasesEvalOptions& options, const std::string& model) {
  if (const auto problem = long_work::write_output(options.output, cases::replies_text(replies))) {
    return refused(*problem);
  }
  const cases::ReplyScore score = cases::reply_score(replies, options.examples.seed);
  if (options.as_json) {
    nlohmann::json figures = cases::score_json(score, failed);
    figures["meta.model"] = model;
    print_with_meta(std::move(figures), command_of(options));
  } else {
    app::print("{}", cases::score_text(score, options.set, model));
  }
  return failed == 0 ? success : some_failed;
}

int eval_cases(const CasesEvalOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  auto opened = open_examples(options.examples);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  auto [planes, source] = std::move(opened).value();
  const std::vector<std::string> records = cases::records_of(source.cases);
  auto chosen =
      cases::cases_by_lot(std::move(source.cases), cases::example_set_from(options.set).value(),
                          options.count, options.examples.file);
  if (!chosen.has_value()) {
    return refused(chosen.error());
  }
  source.cases = std::move(chosen).value();
  SteadyClock clock;
  const auto model =
      open_needed_model(planes->inputs.places, options.model, runtime::Pace::lockstep, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  auto gathered = cases::model_replies(
      source, *model.value(), clock,
      {.journal = options.output + ".journal",
       .title = fmt::format("saca {} cases eval --set {} --car {} --seed {}{}", version_text(),
                            options.set, options.examples.car, options.examples.seed,
                            options.unconstrained ? " --unconstrained" : ""),
       .display = progress_display(),
       .words = options.examples.seed,
       .constrained = !options.unconstrained});
  if (!gathered.has_value()) {
    return refused(gathered.error());
  }
  if (!gathered.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  auto [replies, problems] = *std::move(gathered).value();
  complain_of(problems);
  if (replies.empty()) {
    complain(options.examples.file + ": nothing could be asked");
    return some_failed;
  }
  cases::sort_as_in_file(replies, records);
  return tell_replies(replies, problems.size(), options, model.value()->description());
}

}  // namespace

void add_cases_eval(CLI::App& cases, int& exit_code) {
  CLI::App* const command = cases.add_subcommand(
      "eval", "How well a language model replies to prompts of cases, beside simple rules");
  const auto options = std::make_shared<CasesEvalOptions>();
  add_example_options(*command, options->examples);
  command->add_option("--llm", options->model, "As of `saca reason`")->capture_default_str();
  command->add_option("--set", options->set, "Of which records: those that `export` put into it")
      ->check(CLI::IsMember({"train", "calibration", "test"}))
      ->capture_default_str();
  command
      ->add_option("--count", options->count,
                   "At most so many cases of the set, drawn by lot, always the same")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--output,-o", options->output, "Where the replies go, a line each")
      ->capture_default_str();
  command->add_flag("--unconstrained", options->unconstrained,
                    "Do not hold replies to what is true while they are written");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = eval_cases(*options); });
}

}  // namespace saca::app

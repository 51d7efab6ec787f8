#include "apps/saca/options.h"
#include "saca/base/core/file.h"
#include "saca/lab/cases/case_build.h"
#include "saca/lab/cases/cases_page.h"
#include "saca/lab/cases/chat_set_report.h"
#include "saca/lab/cases/model_replies.h"
#include "saca/lab/cases/opened_examples.h"
#include "saca/lab/cases/reply_report.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

struct BuildCasesOptions : cases::CaseBuildRequest {
  bool as_json = false;
};

ExitCode build_crash_cases(const BuildCasesOptions& options) {
  const cases::CaseOutputs& outputs = options.outputs;
  need_distinct({{"--output", outputs.cases},
                 {"--for-memory", outputs.memory},
                 {"--drivers", outputs.drivers}},
                {{"--journal", options.journal}});
  need_writable({outputs.cases, outputs.memory, outputs.drivers});
  if (options.folders.empty() && options.hundred_car.empty()) {
    refuse(wrong_command_line, "want folders with releases of FARS, or --hundred-car; got neither");
  }
  if (!outputs.drivers.empty() && options.hundred_car.empty()) {
    refuse(wrong_command_line,
           "--drivers: want --hundred-car, too: no other drivers were recorded");
  }
  long_work::watch_for_interrupt();
  const auto [sources, tallies, set] = need_whole(cases::build_cases(here(), options));
  complain_of(set.problems);
  need(cases::write_cases(outputs, set.cases));
  tell(options.as_json, with_meta(cases::tally_json(sources, tallies, set), command_text(options)),
       cases::tally_text(sources, tallies, set, outputs.cases));
  return set.problems.empty() ? success : some_failed;
}

void add_cases_build(CLI::App& cases) {
  const auto [command, options] = add_command<BuildCasesOptions>(
      cases, "build", "Makes cases of recorded crashes: FARS, and the 100-Car study",
      build_crash_cases);
  add(command, "FOLDER", options.folders,
      "Releases of FARS: accident.csv, vehicle.csv and person.csv in each");
  add(command, "--hundred-car", options.hundred_car,
      "Folder of the 100-Car study's release: its emergencies, too");
  add(command, "--count", options.count, "At most so many crashes, of the families in turn",
      CLI::Range(1, 1'000'000));
  add_car(command, options.car);
  add(command, "--seed", options.making.seed, "Of all that is drawn: same seed, same bytes");
  add(command, "--draws", options.making.judging.draws,
      "Of what is left to chance, that harm is the mean of", CLI::Range(2, 1'000));
  add(command, "--told-draws", options.making.judging.told_draws,
      "Of the verdict, that expected harm is the mean of", CLI::Range(1, 1'000));
  add(command, "--tries", options.making.tries,
      "Samples of a record's family until its crash happens without avoidance",
      CLI::Range(1, 1'000));
  add(command, "--output,-o", options.outputs.cases, "Where the cases go");
  add(command, "--for-memory", options.outputs.memory,
      "Besides, without their records, for `saca memory import`");
  add(command, "--drivers", options.outputs.drivers,
      "Besides, of the study's events alone, with what the driver did in the place of what was "
      "best: for saca-train-imitator, not for a memory");
  add(command, "--journal", options.journal, "What was found so far (default: beside the output)");
  add_threads(command, options.threads);
  add_json(command, options.as_json);
}

struct CheckSetsOptions {
  std::vector<std::string> files;
  bool as_json = false;
};

void check_sets(const CheckSetsOptions& options) {
  nlohmann::json sets = nlohmann::json::array();
  const cases::ChatLimits limits;
  for (const std::string& file : options.files) {
    const std::string chats = need(read_file(file, limits.most_bytes + 1));
    const auto checked = need(cases::check_chat_set(chats, file, limits));
    sets.push_back(cases::chat_set_json(file, checked));
    tell_meanwhile(options.as_json, cases::chat_set_text(file, checked));
  }
  tell(options.as_json, nlohmann::json{{"schema", "saca.chat_sets/1"}, {"sets", std::move(sets)}},
       "");
}

void add_cases_check(CLI::App& cases) {
  const auto [command, options] = add_command<CheckSetsOptions>(
      cases, "check",
      "Holds sets of chats against the rules of services for fine-tuning, and counts tokens",
      check_sets);
  add_needed(command, "files", options.files, "JSON Lines of `saca cases export --format openai`");
  add_json(command, options.as_json);
}

void add_example_options(CLI::App& command, cases::ExampleOptions& options) {
  add_needed(command, "FILE", options.file, "What `build` wrote");
  add(command, "--memory", options.memory,
      "A bank whose most alike case prompts tell of; without, they tell of none");
  add(command, "--car", options.car, "That the cases were made with");
  add(command, "--cues", options.cues,
      "Other encounters of the same cases, with the cues of this suite");
  add(command, "--seed", options.seed, "Of the replies' words: same seed, same bytes");
}

struct EvalCasesOptions : cases::EvalRequest {
  bool as_json = false;
};

ExitCode eval_cases(const EvalCasesOptions& options) {
  need_distinct({{"--output", options.output}}, {{"the cases", options.examples.file}});
  need_writable({options.output});
  long_work::watch_for_interrupt();
  const auto [replies, problems, model] = need_whole(cases::evaluate_model(here(), options));
  complain_of(problems);
  if (replies.empty()) {
    refuse(some_failed, options.examples.file + ": nothing could be asked");
  }
  write(options.output, cases::replies_text(replies));
  const cases::ReplyScore score = cases::reply_score(replies, options.examples.seed);
  nlohmann::json figures =
      with_meta(cases::score_json(score, problems.size()), command_text(options));
  figures["meta.model"] = model;
  tell(options.as_json, figures, cases::score_text(score, options.set, model));
  return problems.empty() ? success : some_failed;
}

void add_cases_eval(CLI::App& cases) {
  const auto [command, options] = add_command<EvalCasesOptions>(
      cases, "eval", "How well a language model replies to prompts of cases, beside simple rules",
      eval_cases);
  add_example_options(command, options.examples);
  add(command, "--llm", options.model, "As of `saca reason`");
  add(command, "--set", options.set, "Of which records: those that `export` put into it",
      CLI::IsMember({"train", "calibration", "test"}));
  add(command, "--count", options.count,
      "At most so many cases of the set, drawn by lot, always the same", CLI::Range(1, 1'000'000));
  add(command, "--output,-o", options.output, "Where the replies go, a line each");
  command.add_flag("--unconstrained", options.unconstrained,
                   "Do not hold replies to what is true while they are written");
  add_json(command, options.as_json);
}

struct ExportCasesOptions : cases::ExportRequest {
  bool as_json = false;
};

ExitCode export_cases(const ExportCasesOptions& options) {
  need_writable({fs::path(options.output) / "train.jsonl"});
  long_work::watch_for_interrupt();
  const auto [examples, tallies, problems] = need_whole(cases::export_sets(here(), options));
  tell(
      options.as_json,
      with_meta(cases::sets_json(examples.source, tallies, problems.size()), command_text(options)),
      cases::sets_text(examples.source, tallies, options.output));
  return problems.empty() ? success : some_failed;
}

void add_cases_export(CLI::App& cases) {
  const auto [command, options] = add_command<ExportCasesOptions>(
      cases, "export",
      "Writes prompts and an expert's replies as sets to teach a language model with",
      export_cases);
  add_example_options(command, options.examples);
  add(command, "--format", options.format,
      "local: with what is known of each, for `training/`; openai: chat fine-tuning",
      CLI::IsMember({"local", "openai"}));
  add(command, "--output,-o", options.output, "The folder where the sets go");
  add_threads(command, options.threads);
  add_json(command, options.as_json);
}

struct ShowCasesOptions {
  cases::ShownOptions shown;
  std::string car = "compact_rwd_ev";
  std::string output = "runs/crash_cases.html";
  bool as_json = false;
};

void show_cases(const ShowCasesOptions& options) {
  need_distinct({{"--output", options.output}}, {{"the cases", options.shown.file}});
  need_writable({options.output});
  const auto all = need(cases::read_cases(options.shown.file)).cases;
  const auto inputs = read_inputs(options.car);
  const auto shown = need(cases::shown_cases(all, options.shown));
  const auto page = need(cases::cases_page(
      shown, all, options.shown,
      {.car_name = inputs.car_name, .forecast = {.car = &inputs.car, .harm = &inputs.harm}}));
  write(options.output, report::suite_page(page));
  tell(options.as_json,
       cases::cases_page_json(shown, options.shown.file, options.output, all.size()),
       fmt::format("{}: {} of {} cases\n", options.output, shown.size(), all.size()));
}

void add_cases_show(CLI::App& cases) {
  const auto [command, options] = add_command<ShowCasesOptions>(
      cases, "show", "Cases with their pictures, facts, assumptions and harms", show_cases);
  add_needed(command, "FILE", options.shown.file, "What `build` wrote");
  add(command, "--count", options.shown.count, "How many are drawn", CLI::Range(1, 10'000));
  add(command, "--seed", options.shown.seed, "By which they are drawn");
  add(command, "--family", options.shown.family, "Only of this family");
  add(command, "--record", options.shown.record, "Only of this record, e.g. fars_2016_40001");
  add(command, "--car", options.car, "That they were made for");
  add(command, "--output,-o", options.output, "The page (HTML)");
  add_json(command, options.as_json);
}

}  // namespace

void add_cases(CLI::App& line) {
  CLI::App& cases =
      add_group(line, "cases", "Cases from records of crashes: made, looked at, and taught with");
  add_cases_build(cases);
  add_cases_check(cases);
  add_cases_eval(cases);
  add_cases_export(cases);
  add_cases_show(cases);
}

}  // namespace saca::app

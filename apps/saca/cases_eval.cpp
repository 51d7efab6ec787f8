#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/cases_examples.h"
#include "apps/saca/cases_making.h"
#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/version.h"
#include "saca/base/formats/json_lines.h"
#include "saca/lab/eval/reply_score.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/items_row.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/language_model/retelling.h"

namespace saca::app {
namespace {

using eval::ExampleReply;
using eval::ReplyScore;
using nlohmann::json;

constexpr std::string_view replies_schema = "saca.example_replies/2";
// Of a case and its twin together: without haste, so that every reply comes to its end.
constexpr Clock::Time patience_with_model = std::chrono::seconds(180);

struct CasesEvalOptions {
  ExampleOptions examples;
  std::string model = "local";
  std::string set = "test";
  std::size_t count = 0;  ///< at most so many cases; 0: all of the set
  std::string output = "runs/replies.jsonl";
  bool as_json = false;
};

/// What was replied about one case and its twin.
using ReplyRow = long_work::ItemsRow<ExampleReply>;

/// @param failure  why the model cannot be asked any more, if that is so: the row is then worth
///                 nothing. That an answer is malformed is something that the model said
ReplyRow asked_about(DrawnExamples drawn, language_model::LanguageModel& model, const Clock& clock,
                     std::optional<Error>& failure) {
  ReplyRow row{.items = {}, .problem = std::move(drawn.problem)};
  if (drawn.examples.empty()) {
    return row;
  }
  std::vector<std::string> scenes;
  for (const DrawnExample& each : drawn.examples) {
    scenes.push_back(each.example.prompt);
  }
  const auto replies =
      model.ask(scenes, clock.now() + patience_with_model, [](const language_model::Progress&) {});
  const std::string record = drawn.examples.front().example.record;
  const auto note = [&](const Error& problem) {
    row.problem = record + ": " + problem.message;
    if (problem.code != Error::Code::malformed) {
      failure = Error{problem.code, fmt::format("--llm: {} (in case {}; the same command goes on "
                                                "there)",
                                                problem.message, record)};
    }
  };
  if (!replies.has_value()) {
    note(replies.error());
    return row;
  }
  for (std::size_t i = 0; i < drawn.examples.size(); ++i) {
    DrawnExample& each = drawn.examples[i];
    row.items.push_back(
        eval::example_reply(std::move(each.example), replies.value()[i], each.situation));
    if (const auto problem = eval::try_again(row.items.back(), each.situation, model, clock)) {
      note(*problem);
    }
  }
  return row;
}

int median_of(const std::vector<int>& sorted) {
  return sorted[sorted.size() / 2];
}

json figures_of(const ReplyScore& score, int failed, const std::string& command,
                const std::string& model) {
  json out{{"meta.command", "saca " + command},
           {"meta.version", SACA_VERSION},
           {"meta.model", model},
           {"eval.num_examples", score.examples},
           {"eval.num_known", score.known},
           {"eval.num_failed", failed},
           {"eval.ended", score.ended},
           {"eval.text_and_answer_agree", score.agrees},
           {"eval.statements_checked", score.statements},
           {"eval.true_statements", score.true_statements},
           {"eval.true_replies", score.true_replies},
           {"eval.unfounded", score.unfounded},
           {"eval.shown", score.shown},
           {"eval.shown_in_part", score.shown_in_part},
           {"eval.shown_at_last", score.shown_at_last},
           {"eval.tokens.p50", median_of(score.tokens)},
           {"eval.tokens.max", score.tokens.back()}};
  add_estimate(out, "eval.twins.needless", score.needless);
  for (const eval::ReplyChoice& one : score.choices) {
    const std::string key = fmt::format("eval.{}.", one.key);
    add_estimate(out, key + "best_within", one.best_within);
    add_estimate(out, key + "admissible", one.admissible);
    add_estimate(out, key + "harm", one.harm);
    add_estimate(out, key + "regret", one.regret);
    add_estimate(out, key + "above_rule", one.above_rule);
  }
  if (score.calibration) {
    out["eval.temperature"] = score.calibration->temperature;
    out["eval.log_loss"] = score.calibration->log_loss_now;
    out["eval.log_loss_at_temperature"] = score.calibration->log_loss;
  }
  return out;
}

void print(const ReplyScore& score, const CasesEvalOptions& options, const std::string& model) {
  app::print("{} examples of the {} set, {}; of {} the harm of every policy is known\n\n",
             score.examples, options.set, model, score.known);
  app::print("{:42} {:>22} {:>12} {:>24} {:>24}\n", "choice", "best of admissible, %",
             "admissible,%", "regret", "harm above the rule's");
  for (const eval::ReplyChoice& one : score.choices) {
    app::print("{:42} {:>22} {:12.1f} {:>24} {:>24}\n", one.title,
               with_interval(one.best_within, 1, 100.0), 100.0 * one.admissible.value,
               with_interval(one.regret, 4), with_interval(one.above_rule, 4));
  }
  app::print(
      "\nThe rule: AEB where it is admissible, else the mildest. In twins, where nothing has to be "
      "done, the model\nintervenes in {} %.\n\n{:.1f} % of the replies end by themselves, of {} "
      "tokens (median; at most {}); {:.1f} % conclude as they answer.\n{:.1f} statements of each "
      "can be checked, {:.1f} % of them are true; in {:.1f} % of the replies all are; {:.1f} % of "
      "the choices\nrest on something false. As the reason {:.1f} % are shown as they are, {:.1f} "
      "% without what does not hold,\n{:.1f} % where the model may try {} times; in place of the "
      "others the figures are told.\n",
      with_interval(score.needless, 1, 100.0), 100.0 * score.ended, median_of(score.tokens),
      score.tokens.back(), 100.0 * score.agrees, score.statements, 100.0 * score.true_statements,
      100.0 * score.true_replies, 100.0 * score.unfounded, 100.0 * score.shown,
      100.0 * score.shown_in_part, 100.0 * score.shown_at_last, language_model::most_tries);
  if (score.calibration) {
    app::print("Temperature: {:.2f} (log loss {:.3f}, as it is {:.3f}; {} examples)\n",
               score.calibration->temperature, score.calibration->log_loss,
               score.calibration->log_loss_now, score.calibration->count);
  }
}

std::optional<Error> write_replies(const std::string& path,
                                   const std::vector<ExampleReply>& replies) {
  std::string lines = formats::first_json_line(replies_schema, "replies", replies.size());
  for (const ExampleReply& one : replies) {
    lines += eval::to_json(one).dump() + '\n';
  }
  return long_work::write_output(path, lines);
}

/// By something that has nothing to do with what they are, so that the first few stand for all:
/// files have them by state, year and number.
void sort_by_lot(std::vector<eval::CrashCase>& cases) {
  const auto lot = [](const eval::CrashCase& one) {
    return std::pair(number_of_record(one.record.name), one.record.name);
  };
  std::sort(cases.begin(), cases.end(),
            [&](const auto& a, const auto& b) { return lot(a) < lot(b); });
}

/// The cases of the set, the first few of a lot.
/// @return  out_of_range: there is none
std::optional<Error> choose_cases(std::vector<eval::CrashCase>& cases,
                                  const CasesEvalOptions& options) {
  const eval::ExampleSet set = eval::example_set_from(options.set).value();
  std::erase_if(cases, [set](const eval::CrashCase& one) {
    return eval::set_of_record(one.record.name) != set;
  });
  sort_by_lot(cases);
  if (options.count > 0 && cases.size() > options.count) {
    cases.resize(options.count);
  }
  return cases.empty() ? std::optional(Error{Error::Code::out_of_range,
                                             options.examples.file + ": want cases of the " +
                                                 options.set + " set, got none"})
                       : std::nullopt;
}

/// What is replied about each case; nullopt: interrupted.
Result<std::optional<std::vector<ReplyRow>>> replies_to(const ExampleSource& source,
                                                        language_model::LanguageModel& model,
                                                        const Clock& clock,
                                                        const CasesEvalOptions& options) {
  std::optional<Error> failure;
  return long_work::rows_of<ReplyRow>(
      {.journal = options.output + ".journal",
       .title = fmt::format("saca {} cases eval --set {} --car {} --seed {} ({:016x}) {}",
                            version_text(), options.set, options.examples.car,
                            options.examples.seed, source.digest, model.description()),
       .progress = "replies",
       .unit = "cases",
       .count = source.cases.size(),
       .display = progress_display(),
       .threads = 1,  // the model uses all cores
       .row =
           [&](std::size_t i) {
             return asked_about(drawn_examples(source.cases[i], source, options.examples), model,
                                clock, failure);
           },
       .line_of = long_work::items_line<ExampleReply>,
       .row_from =
           [](const std::string& line) {
             return long_work::items_row<ExampleReply>(line, eval::example_reply_from_json);
           },
       .spoilt_by_interrupt = true,  // it reaches the model's process, too
       .failure = [&failure] { return failure; }});
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
  ExampleSource source = std::move(opened).value();
  std::map<std::string, std::size_t> places;  // in the file
  for (const eval::CrashCase& one : source.cases) {
    places.emplace(one.record.name, places.size());
  }
  if (const auto problem = choose_cases(source.cases, options)) {
    return refused(*problem);
  }
  SteadyClock clock;
  const auto model = open_needed_model(source.planes->inputs.places, options.model,
                                       runtime::Pace::lockstep, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  auto rows = replies_to(source, *model.value(), clock, options);
  if (!rows.has_value()) {
    return refused(rows.error());
  }
  if (!rows.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  auto [replies, problems] = long_work::all_items(*std::move(rows).value());
  complain_of(problems);
  const auto failed = static_cast<int>(problems.size());
  std::stable_sort(replies.begin(), replies.end(),
                   [&](const ExampleReply& a, const ExampleReply& b) {
                     return places.at(a.example.record) < places.at(b.example.record);
                   });
  if (replies.empty()) {
    complain(options.examples.file + ": nothing could be asked");
    return some_failed;
  }
  if (const auto problem = write_replies(options.output, replies)) {
    return refused(*problem);
  }
  const ReplyScore score = eval::reply_score(replies, options.examples.seed);
  const std::string description = model.value()->description();
  if (options.as_json) {
    const std::string command =
        fmt::format("cases eval {} --set {}{} --llm {} {}", options.examples.file, options.set,
                    options.count > 0 ? fmt::format(" --count {}", options.count) : "",
                    options.model, example_text(options.examples));
    app::print_json(figures_of(score, failed, command, description));
  } else {
    print(score, options, description);
  }
  return failed == 0 ? success : some_failed;
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
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = eval_cases(*options); });
}

}  // namespace saca::app

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/surveying.h"
#include "saca/lab/eval/model_score.h"

namespace saca::app {
namespace {

using eval::Estimate;
using eval::MethodFigures;
using eval::ModelScore;
using nlohmann::json;

struct ScoreOptions {
  SurveyOptions survey;
  std::string model = "local";
  bool as_json = false;
};

json interval_of(const Estimate& estimate) {
  return {
      {"mean", estimate.value}, {"low", estimate.low}, {"high", estimate.high}, {"n", estimate.n}};
}

/// What was said, beside what was carried out.
json talk_of(const encounter::ThinkingFigures& said) {
  const auto share = [](int part, int of) {
    return of > 0 ? json(static_cast<double>(part) / of) : json();
  };
  return {
      {"asked", said.asked},
      {"answered_share", share(said.answered, said.asked)},
      {"ended_share", share(said.ended, said.answered)},
      {"statements_checked", said.statements},
      {"statements_true_share", share(said.statements - said.false_statements, said.statements)},
      {"unfounded_share", share(said.unfounded, said.answered)}};
}

json document_of(const ModelScore& score, const ScoreOptions& options, const SuiteRun& run) {
  json document = {
      {"schema", "saca.model_score/2"},
      {"command",
       fmt::format("{} --llm {}", command_line(options.survey, "model score"), options.model)},
      {"model", run.meta.at("meta.model")},
      {"encounters", score.choices.front().harm.n},
      {"choices", json::object()}};
  for (std::size_t i = 0; i < score.choices.size(); ++i) {
    const MethodFigures& figures = score.choices[i];
    const std::string_view key = eval::scored_choices()[i].key;
    document["choices"][std::string(key)] = {{"method", figures.method},
                                             {"right", interval_of(figures.right)},
                                             {"harm", interval_of(figures.harm)},
                                             {"regret", interval_of(figures.regret)},
                                             {"contact", interval_of(figures.contact)},
                                             {"needless", interval_of(figures.needless)},
                                             {"sources", figures.sources}};
    if (key == "facts_reasoned" || key == "no_facts_reasoned") {
      document[key == "facts_reasoned" ? "with_facts" : "without_facts"] =
          talk_of(figures.thinking.value_or(encounter::ThinkingFigures{}));
    }
  }
  if (const auto& calibration = score.calibration) {
    document["temperature"] = {{"best", calibration->temperature},
                               {"log_loss", calibration->log_loss},
                               {"log_loss_as_it_is", calibration->log_loss_now},
                               {"n", calibration->count}};
  }
  return document;
}

std::string percent(const json& share) {
  return share.is_null() ? "none" : fmt::format("{:.0f} %", 100.0 * share.get<double>());
}

void print(const ModelScore& score, const json& document) {
  app::print("{} encounters, {}; means with 95 % intervals of what was carried out\n\n",
             document["encounters"].get<int>(), document["model"].get<std::string>());
  app::print("{:36} {:>22} {:>26} {:>9} {:>11} {:>9}\n", "choice", "as good as the best, %",
             "regret", "contact,%", "needless,%", "by model");
  for (std::size_t i = 0; i < score.choices.size(); ++i) {
    const MethodFigures& one = score.choices[i];
    const auto by_model = one.sources.find("model");
    app::print("{:36} {:>22} {:>26} {:9.1f} {:>11} {:9}\n", eval::scored_choices()[i].title,
               with_interval(one.right, 1, 100.0), with_interval(one.regret, 4),
               100.0 * one.contact.value,
               one.needless.n == 0 ? "-" : fmt::format("{:.1f}", 100.0 * one.needless.value),
               by_model == one.sources.end() ? 0 : by_model->second);
  }
  for (const char* key : {"with_facts", "without_facts"}) {
    const json& talk = document[key];
    app::print(
        "\n{}: of {} forecasts asked about {} got an answer in time, {} of these replies end by "
        "themselves; of {} statements that can be checked {} are true; {} of the choices rest on "
        "something false",
        std::string_view(key) == "with_facts" ? "With facts" : "Without", talk["asked"].get<int>(),
        percent(talk["answered_share"]), percent(talk["ended_share"]),
        talk["statements_checked"].get<int>(), percent(talk["statements_true_share"]),
        percent(talk["unfounded_share"]));
  }
  app::print("\n");
  if (const auto& calibration = score.calibration) {
    app::print("Temperature: {:.2f} (log loss {:.3f}, as it is {:.3f}; {} encounters)\n",
               calibration->temperature, calibration->log_loss, calibration->log_loss_now,
               calibration->count);
  }
}

int model_score(const ScoreOptions& options) {
  if (options.model == "off") {
    return refused({Error::Code::malformed, "--llm: want a language model to ask, got `off`"});
  }
  const SurveyOptions& survey = options.survey;
  const SuiteCommandOptions suite{
      .name = survey.suite,
      .count = survey.count,
      .split = survey.split,
      .test_log = survey.test_log,
      .car = survey.car,
      .thinking = {.memory = "", .model = options.model},
      .no_twins = true,
      .journal = survey.journal.empty()
                     ? fmt::format("runs/model-score-{}-{}.journal", survey.suite, survey.split)
                     : survey.journal,
      .threads = survey.threads};
  const auto ran = run_suite(suite, "model score", eval::scored_methods());
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const std::vector<eval::SuiteRow>& rows = ran.value()->rows;
  const auto num_faults = std::count_if(
      rows.begin(), rows.end(), [](const eval::SuiteRow& row) { return !row.fault.empty(); });
  if (static_cast<std::size_t>(num_faults) == rows.size()) {
    complain(survey.suite + ": no encounter could be played; the journal holds why");
    return some_failed;
  }
  const ModelScore score = eval::model_score(rows, suite.seed);
  const json document = document_of(score, options, *ran.value());
  if (options.as_json) {
    app::print_json(document);
  } else {
    print(score, document);
  }
  return num_faults > 0 ? some_failed : success;
}

}  // namespace

void add_model_score(CLI::App& model, int& exit_code) {
  CLI::App* const command = model.add_subcommand("score",
                                                 "How well it chooses in closed loop over a suite, "
                                                 "with and without our facts; can be interrupted");
  const auto options = std::make_shared<ScoreOptions>();
  options->survey.count = 300;
  options->survey.split = "calibration";
  add_survey_options(*command, options->survey);
  command->get_option("--count")->check(CLI::Range(2, 10'000'000));
  command->add_option("--llm", options->model, "As of `saca reason`")->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = model_score(*options); });
}

}  // namespace saca::app

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_running.h"
#include "apps/saca/surveying.h"
#include "saca/lab/eval/model_score.h"
#include "saca/lab/model_trials/model_score_report.h"

namespace saca::app {
namespace {

struct ScoreOptions {
  SurveyOptions survey;
  std::string model = "local";
  bool as_json = false;
};

int model_score(const ScoreOptions& options) {
  if (options.model == "off") {
    return refused({Error::Code::malformed, "--llm: want a language model to ask, got `off`"});
  }
  const SurveyOptions& survey = options.survey;
  const suites::SuiteRequest suite{
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
  const eval::ModelScore score = eval::model_score(rows, suite.seed);
  const auto description = ran.value()->meta.at("meta.model").get<std::string>();
  if (options.as_json) {
    app::print_json(model_trials::model_score_json(
        score, fmt::format("{} --llm {}", command_line(survey, "model score"), options.model),
        description));
  } else {
    app::print("{}", model_trials::model_score_text(score, description));
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

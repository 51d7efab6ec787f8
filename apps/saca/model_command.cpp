#include <algorithm>
#include <chrono>

#include "apps/saca/options.h"
#include "saca/lab/eval/model_score.h"
#include "saca/lab/installation/model_sources.h"
#include "saca/lab/model_trials/bench_report.h"
#include "saca/lab/model_trials/model_info.h"
#include "saca/lab/model_trials/model_score_report.h"
#include "saca/lab/suites/opened_suite.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::app {
namespace {

struct InfoOptions {
  bool as_json = false;
};

void tell_info(const InfoOptions& options) {
  SteadyClock clock;
  const auto model = need(model_access::open_local_model(installation::model_sources(here()),
                                                         runtime::Pace::real, clock));
  const auto info = need(model->info(clock.now() + std::chrono::seconds(30)), too_slow);
  const nlohmann::json out = model_trials::model_info(info, model->figures());
  tell(options.as_json, model_trials::model_info_json(out), model_trials::model_info_text(out));
}

struct BenchOptions {
  std::string model = "local";
  int runs = 10;
  bool as_json = false;
};

void bench_model(const BenchOptions& options) {
  SteadyClock clock;
  const auto model = need(model_access::open_needed_model(
      installation::model_sources(here()), options.model, runtime::Pace::real, clock, "--llm"));
  const auto bench = need(model_trials::bench_of(*model, options.runs, clock), too_slow);
  const auto figures = model_trials::bench_figures(bench, *model, clock);
  tell(options.as_json, model_trials::bench_json(figures), model_trials::bench_text(figures));
}

struct ScoreOptions {
  installation::SurveyRequest survey{.draw = {.count = 300, .split = "calibration"}};
  std::string model = "local";
  bool as_json = false;
};

ExitCode score_model(const ScoreOptions& options) {
  if (options.model == "off") {
    refuse(bad_input, "--llm: want a language model to ask, got `off`");
  }
  suites::SuiteRequest suite = suites::suite_of(options.survey);
  suite.thinking = {.memory = "", .model = options.model};
  if (suite.journal.empty()) {
    suite.journal = fmt::format("runs/model-score-{}-{}.journal", suite.name, suite.split);
  }
  const auto run =
      need_whole(suites::run_suite(here(), suite, "model score", eval::scored_methods()));
  const std::string failures = suites::failures_text(run);
  if (std::none_of(run.rows.begin(), run.rows.end(), eval::counts_in_figures)) {
    refuse(some_failed, suite.name + ": " + failures);
  }
  const eval::ModelScore score = eval::model_score(run.rows, suite.seed);
  const auto description = run.meta.at("meta.model").get<std::string>();
  tell(options.as_json,
       model_trials::model_score_json(
           score, command_line(options.survey, "model score") + " --llm " + options.model,
           description),
       model_trials::model_score_text(score, description) +
           (failures.empty() ? "" : failures + "\n"));
  return failures.empty() ? success : some_failed;
}

}  // namespace

void add_model(CLI::App& line) {
  CLI::App& model = add_group(line, "model", "The local language model");
  const auto info = add_command<InfoOptions>(model, "info",
                                             "Which it is, its size, how fast it loads", tell_info);
  add_json(info.line, info.options.as_json);

  const auto bench = add_command<BenchOptions>(
      model, "bench", "How fast it answers, about one forecast without haste and three in 4.2 s",
      bench_model);
  add(bench.line, "--llm", bench.options.model, "As of `saca reason`");
  add(bench.line, "--runs", bench.options.runs, "", CLI::Range(1, 10'000));
  add_json(bench.line, bench.options.as_json, "One flat object");

  const auto [score, options] = add_command<ScoreOptions>(
      model, "score",
      "How well it chooses in closed loop over a suite, with and without our facts; can be "
      "interrupted",
      score_model);
  add_survey_options(score, options.survey);
  score.get_option("--journal")
      ->description("What was found so far (default: runs/model-score-SUITE-SPLIT.journal)");
  score.get_option("--count")->check(CLI::Range(2, 10'000'000));
  add(score, "--llm", options.model, "As of `saca reason`");
  add_json(score, options.as_json);
}

}  // namespace saca::app

#include "apps/saca/options.h"
#include "saca/lab/forecast_study/figures_report.h"
#include "saca/lab/forecast_study/study_request.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

struct EvalForecastOptions {
  suites::SuiteRequest from;
  bool as_json = false;
};

ExitCode eval_forecasts(const EvalForecastOptions& options) {
  const suites::SuiteRequest& from = options.from;
  need_writable({from.output});
  long_work::watch_for_interrupt();
  auto studied = forecast_study::study_of(here(), from);
  if (long_work::interrupted()) {
    refuse(was_interrupted, "interrupted; nothing was kept: the same command begins anew");
  }
  const auto study = need(std::move(studied));
  complain_of(forecast_study::problems_of(study));
  const auto figures = forecast_study::figures_of(study, from.seed);
  const auto document = json_of(
      figures, {from.name, "saca " + forecast_study::command_text(from), from.seed, SACA_VERSION});
  if (!from.output.empty()) {
    write(from.output, json_text(document));
  }
  tell(options.as_json, document, text_of(figures, from.name, study.notes));
  return figures.num_failed > 0 ? some_failed : success;
}

struct ShowForecastOptions : forecast_study::FanRequest {
  std::string output;
};

void show_forecast(const ShowForecastOptions& options) {
  need_writable({options.output});
  write(options.output, need(forecast_study::picture_of(here(), options)));
  app::print("{}\n", options.output);
}

}  // namespace

void add_forecast(CLI::App& line) {
  CLI::App& forecast =
      add_group(line, "forecast", "How well it is predicted where road users will be");
  const auto [eval, of_eval] = add_command<EvalForecastOptions>(
      forecast, "eval",
      "Hold forecasts against what happens in many encounters, beside simpler ones",
      eval_forecasts);
  add_encounter_options(eval, of_eval.from);
  eval.get_option("name")->description(
      "A suite (natural, balanced), a family, a folder of scenarios, 100car, or traffic: others "
      "around recorded cars, judged by intentions that have not seen the site");
  eval.get_option("--data")->description(
      "Of 100car the folder of the study's release; of traffic folders with CommonRoad files, of "
      "each site at most --count drives");
  add(eval, "--output", of_eval.from.output, "The figures as JSON, besides");
  add_threads(eval, of_eval.from.threads);
  add_json(eval, of_eval.as_json);

  const auto [show, options] = add_command<ShowForecastOptions>(
      forecast, "show",
      "Draw what is forecast of one road user at one instant, and what then happened",
      show_forecast);
  add_encounter_options(show, options.from);
  show.remove_option(show.get_option("--count"));
  add_needed(show, "--encounter", options.encounter, "Number of the encounter in it");
  add_needed(show, "--who", options.who, "car1, pedestrian2, ...");
  add_needed(show, "--at-s", options.at, "When [s]");
  add_needed(show, "-o,--output", options.output, "The picture (.svg)");
}

}  // namespace saca::app

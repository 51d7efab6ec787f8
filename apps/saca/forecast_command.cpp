#include <fmt/core.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/surveying.h"
#include "apps/saca/within.h"
#include "saca/lab/forecast_study/figures_report.h"
#include "saca/lab/forecast_study/forecast_figures.h"
#include "saca/lab/forecast_study/suite_forecasts.h"
#include "saca/lab/forecast_study/traffic_forecasts.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

using forecast_study::ForecastStudy;

constexpr std::string_view traffic_name = "traffic";

struct ForecastCommand {
  suites::SuiteRequest from;  ///< which encounters; nothing is decided in them
  bool as_json = false;
};

Result<ForecastStudy> study_suite(const suites::SuiteRequest& options) {
  const auto encounters = open_encounters(options, "forecast eval");
  if (!encounters.has_value()) {
    return encounters.error();
  }
  const Inputs& inputs = encounters.value().inputs;
  const auto mixture = forecast_study::read_places_model(inputs.places.root / "models", "model");
  if (!mixture.has_value()) {
    return mixture.error();
  }
  return forecast_study::suite_forecasts(
      {.at = encounters.value().at,
       .count = static_cast<std::size_t>(encounters.value().count),
       .perceiver = perceiver_of(inputs),
       .mixture = &mixture.value(),
       .play = {.seed = options.seed, .exact = options.exact},
       .threads = options.threads});
}

Result<ForecastStudy> study_traffic(const suites::SuiteRequest& options) {
  if (options.data.empty()) {
    return Error{Error::Code::out_of_range,
                 "--data: want folders with CommonRoad files (*.xml), got none"};
  }
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  return forecast_study::traffic_forecasts({.folders = {options.data.begin(), options.data.end()},
                                            .most = static_cast<std::size_t>(options.count),
                                            .models = inputs.value().places.root / "models",
                                            .car = &inputs.value().car,
                                            .harm = &inputs.value().harm,
                                            .play = {.seed = options.seed, .exact = options.exact},
                                            .threads = options.threads});
}

std::string study_command(const suites::SuiteRequest& from) {
  return fmt::format("saca forecast eval {} --count {} --split {} --car {} --seed {}{}{}",
                     from.name, from.count, from.split, from.car, from.seed,
                     from.exact ? " --exact" : "", from.data.empty() ? "" : " --data FOLDER");
}

int run(const ForecastCommand& options) {
  const suites::SuiteRequest& from = options.from;
  if (const auto problem = long_work::why_outputs_unwritable({from.output})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const auto study = from.name == traffic_name ? study_traffic(from) : study_suite(from);
  if (long_work::interrupted()) {
    complain("interrupted; nothing was kept: the same command begins anew");
    return was_interrupted;
  }
  if (!study.has_value()) {
    return refused(study.error());
  }
  complain_of(forecast_study::problems_of(study.value()));
  const auto figures = forecast_study::figures_of(study.value(), from.seed);
  if (!options.as_json) {
    app::print("{}", text_of(figures, from.name, study.value().notes));
  }
  const std::string text =
      json_text(json_of(figures, {from.name, study_command(from), from.seed, SACA_VERSION})) + "\n";
  if (!from.output.empty()) {
    if (const auto problem = long_work::write_output(from.output, text)) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print("{}", text);
  }
  return figures.num_failed > 0 ? some_failed : success;
}

void add_forecast_eval(CLI::App& forecast, int& exit_code) {
  CLI::App* const command = forecast.add_subcommand(
      "eval", "Hold forecasts against what happens in many encounters, beside simpler ones");
  const auto options = std::make_shared<ForecastCommand>();
  suites::SuiteRequest& from = options->from;
  add_encounter_options(*command, from);
  command->get_option("name")->description(
      "A suite (natural, balanced), a family, a folder of scenarios, 100car, or traffic: others "
      "around recorded cars, judged by intentions that have not seen the site");
  command->get_option("--data")->description(
      "Of 100car the folder of the study's release; of traffic folders with CommonRoad files, of "
      "each site at most --count drives");
  command->add_option("--output", from.output, "The figures as JSON, besides");
  add_threads(*command, from.threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace

suites::Perceiver perceiver_of(const Inputs& inputs) {
  return {.car = &inputs.car, .harm = &inputs.harm, .intent = &inputs.intent};
}

void add_encounter_options(CLI::App& command, suites::SuiteRequest& from) {
  command
      .add_option("name", from.name,
                  "A suite (natural, balanced), a family, a folder of scenarios, or 100car")
      ->required();
  command.add_option("--data", from.data, "Of 100car the folder of the study's release");
  add_draw_options(command, from.count, from.split, from.test_log, from.car);
  command.add_option("--seed", from.seed, "Of all that is drawn: same seed, same figures")
      ->capture_default_str();
  command.add_flag("--exact", from.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
}

void add_forecast(CLI::App& line, int& exit_code) {
  CLI::App* const forecast =
      line.add_subcommand("forecast", "How well it is predicted where road users will be");
  forecast->require_subcommand(1);
  add_forecast_eval(*forecast, exit_code);
  add_forecast_show(*forecast, exit_code);
}

}  // namespace saca::app

#include "apps/saca/suite_running.h"

#include <fmt/core.h>

#include <memory>
#include <utility>

#include "apps/saca/danger_check.h"
#include "apps/saca/model.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_sources.h"
#include "apps/saca/surveying.h"
#include "apps/saca/thresholds_options.h"
#include "apps/saca/version.h"
#include "apps/saca/within.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/suite_play.h"

namespace saca::app {
namespace {

/// The weights that are named.
/// @return  an error where they are of another car
Result<std::shared_ptr<const learned_danger::Network>> danger_of(
    const suites::SuiteRequest& options, const Inputs& inputs) {
  if (options.danger.empty()) {
    return std::shared_ptr<const learned_danger::Network>();
  }
  auto weights = read_danger_weights(options.danger);
  if (!weights.has_value()) {
    return weights.error();
  }
  const std::string ours = learned_danger::vehicle_word(inputs.car);
  if (learned_danger::vehicle_word(weights.value().inputs.car) != ours) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want weights of {}, got those of {}", options.danger,
                             inputs.car_name, weights.value().car_name)};
  }
  return std::make_shared<const learned_danger::Network>(std::move(weights).value().network);
}

Result<suites::SuiteBench> open_bench(const suites::SuiteRequest& options,
                                      const std::string& command,
                                      const std::vector<std::string>& methods) {
  auto source = open_encounters(options, command);
  if (!source.has_value()) {
    return source.error();
  }
  SuiteEncounters opened = std::move(source).value();
  auto planes = open_planes(std::move(opened.inputs), options.thresholds);
  if (!planes.has_value()) {
    return planes.error();
  }
  const std::shared_ptr<const PlanesOfCar> of_car = std::move(planes).value();
  Clock& clock = *of_car->setup.clock;
  const Places& places = of_car->inputs.places;
  auto thinking = suites::SuiteThinking::open(options.thinking, lockstep_models(places, clock),
                                              made_with(*of_car), options.threads, clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  auto danger = danger_of(options, of_car->inputs);
  if (!danger.has_value()) {
    return danger.error();
  }
  auto imitators = suites::imitators_of(methods, places.root / "models");
  if (!imitators.has_value()) {
    return imitators.error();
  }
  return suites::SuiteBench{.source = std::move(opened),
                            .setup = {of_car, &of_car->setup},
                            .intent = {of_car, &of_car->inputs.intent},
                            .thinking = std::move(thinking).value(),
                            .danger = std::move(danger).value(),
                            .imitators = std::move(imitators).value()};
}

}  // namespace

suites::SuiteThinking::OpenModel lockstep_models(const Places& places, Clock& clock) {
  return [places, &clock](const std::string& choice, const char* option) {
    return open_needed_model(places, choice, runtime::Pace::lockstep, clock, option);
  };
}

suites::SuiteCaller caller_of(const std::string& command) {
  return {.command = command,
          .version = SACA_VERSION,
          .built_from = version_text(),
          .display = progress_display()};
}

Result<std::optional<SuiteRun>> run_suite(const suites::SuiteRequest& options,
                                          const std::string& command,
                                          const std::vector<std::string>& methods) {
  auto bench = open_bench(options, command, methods);
  if (!bench.has_value()) {
    return bench.error();
  }
  return suites::play_suite(std::move(bench).value(), options, methods, caller_of(command));
}

Result<std::string> write_encounter(const suites::SuiteRequest& options, std::uint64_t number) {
  const auto source = open_encounters(options, "suite");
  if (!source.has_value()) {
    return source.error();
  }
  const auto replay = suites::replay_of(source.value(), options, number);
  if (!replay.has_value()) {
    return replay.error();
  }
  if (auto problem = long_work::write_output(replay.value().file, replay.value().text)) {
    return *problem;
  }
  return replay.value().command;
}

void add_suite_options(CLI::App& command, suites::SuiteRequest& options) {
  command
      .add_option(
          "name", options.name,
          "A suite (natural, balanced), a family, a table of the paper (table_2, table_2_late, "
          "table_3), a folder of scenarios, 100car, traffic, or a regulation (fmvss127, r152)")
      ->required();
  command.add_option("--data", options.data,
                     "Of 100car the folder of the study's release; of traffic (SACA in shadow) "
                     "folders with CommonRoad files or that release");
  add_draw_options(command, options.count, options.split, options.test_log, options.car);
  add_thinking_options(command, options.thinking);
  add_thresholds_options(command, options.thresholds);
  command.add_option("--danger", options.danger,
                     "Weights of V_h and Q_h (models/danger), for methods that choose by them");
  command.add_option("--seed", options.seed, "Of all that is drawn: same seed, same rows")
      ->capture_default_str();
  command.add_flag("--exact", options.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
  command.add_option("--output", options.output,
                     "Rows as HDF5; beside them .json and .html (default: runs/...)");
  add_threads(command, options.threads);
}

}  // namespace saca::app

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/danger_check.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/stopped.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/danger_study/coverage_report.h"
#include "saca/lab/danger_study/danger_model.h"
#include "saca/lab/learned_danger/coverage.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

using learned_danger::CoverageSurvey;

struct CoverageOptions {
  std::string folder;
  int states = 200;
  int others = 20'000;
  int threads = usual_threads();
  bool as_json = false;
};

int tell_coverage(const CoverageOptions& options) {
  long_work::watch_for_interrupt();
  const auto files = learned_danger::part_files(options.folder);
  if (!files.has_value()) {
    return refused(files.error());
  }
  const auto first = learned_danger::read_part(files.value().front());
  if (!first.has_value()) {
    return refused(first.error());
  }
  const auto inputs = read_inputs(first.value().car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto model =
      danger_study::model_of_drawn(danger_sources(inputs.value()), danger_study::TableUse::solved);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const auto all =
      danger_study::coverage_of(first.value(), files.value(), inputs.value().car, model.value(),
                                {.folder = options.folder,
                                 .states = static_cast<std::size_t>(options.states),
                                 .others = static_cast<std::size_t>(options.others),
                                 .threads = options.threads,
                                 .display = progress_display()});
  if (!all.has_value()) {
    return stopped(all.error());
  }
  if (!options.as_json) {
    app::print("{}", danger_study::text_of(all.value()));
    return success;
  }
  nlohmann::json figures = danger_study::json_of(all.value());
  figures.update({{"meta.car", inputs.value().car_name}, {"meta.threads", options.threads}});
  print_json(figures);
  return success;
}

}  // namespace

void add_danger_coverage(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<CoverageOptions>();
  CLI::App* const command = danger.add_subcommand(
      "coverage",
      "How near the inputs of a data set come to the exact best ones, by speed and grip");
  command->add_option("FOLDER", options->folder, "Of the parts that `saca danger dataset` made")
      ->required();
  command
      ->add_option("--states", options->states,
                   "Of each bin, whose best inputs are looked for, at most")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--among", options->others, "Likewise, among which they are looked for")
      ->check(CLI::Range(static_cast<int>(CoverageSurvey::num_alike), 10'000'000))
      ->capture_default_str();
  add_threads(*command, options->threads, "They do not change the figures");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = tell_coverage(*options); });
}

}  // namespace saca::app

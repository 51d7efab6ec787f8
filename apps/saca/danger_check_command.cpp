#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/danger_check.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/stopped.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/danger_study/check_report.h"
#include "saca/lab/danger_study/check_situations.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

struct DangerCheckOptions {
  std::string weights;
  int situations = 20'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

int check_danger(const DangerCheckOptions& options) {
  long_work::watch_for_interrupt();
  const auto read = read_danger_weights(options.weights);
  if (!read.has_value()) {
    return refused(read.error());
  }
  const DangerWeights& weights = read.value();
  const auto margins = learned_danger::Margins::from(weights.network.words(), options.weights);
  if (!margins.has_value()) {
    return refused(margins.error());
  }
  const auto all = danger_study::checked_situations(
      weights.inputs.car, weights.network,
      {options.situations, options.seed, options.threads, progress_display()});
  if (!all.has_value()) {
    return stopped(all.error());
  }
  const SteadyClock clock;
  const danger_study::CheckReport report = danger_study::check_report(
      all.value(), margins.value(), danger_study::microseconds_of_value(weights.network, clock));
  if (!options.as_json) {
    app::print("{}", danger_study::text_of(report));
    return success;
  }
  nlohmann::json figures = danger_study::json_of(report);
  figures.update({{"meta.weights", options.weights},
                  {"meta.car", weights.car_name},
                  {"meta.situations", options.situations},
                  {"meta.seed", std::to_string(options.seed)}});
  print_json(figures);
  return success;
}

}  // namespace

void add_danger_check(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<DangerCheckOptions>();
  CLI::App* const command = danger.add_subcommand(
      "check", "Drive the full vehicle by learnt V_h and Q_h, and tell how often they are wrong");
  command->add_option("WEIGHTS", options->weights, "safetensors file of saca-train-danger")
      ->required();
  command->add_option("--situations", options->situations)
      ->check(CLI::Range(2, 10'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  add_threads(*command, options->threads, "They do not change the figures");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = check_danger(*options); });
}

}  // namespace saca::app

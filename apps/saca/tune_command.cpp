#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/tune/trials.h"
#include "saca/lab/vehicle_study/tuning_report.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct TuneOptions {
  std::string car = "compact_rwd_ev";
  std::string from;
  std::string output;
  int swerve_evaluations = 1'500;
  int drift_evaluations = 4'000;
  int draws = 200;
  unsigned long seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

std::string command_line(const TuneOptions& options) {
  return fmt::format(
      "saca tune --car {} --from {} --swerve-evaluations {} --drift-evaluations {} "
      "--draws {} --seed {}",
      options.car, options.from, options.swerve_evaluations, options.drift_evaluations,
      options.draws, options.seed);
}

int stopped(const fs::path& output) {
  complain(
      fmt::format("interrupted; {} was not written. The same command goes on where this one "
                  "stopped.",
                  output.string()));
  return was_interrupted;
}

/// Finds the tuning of a car that begins with another one's, and writes it.
int find_tuning(const TuneOptions& options, const fs::path& output, manoeuvre::Car car) {
  const vehicle_study::TuningWork work{.program = "saca " SACA_VERSION,
                                       .car = options.car,
                                       .swerve_evaluations = options.swerve_evaluations,
                                       .drift_evaluations = options.drift_evaluations,
                                       .seed = options.seed,
                                       .threads = options.threads,
                                       .output = output,
                                       .display = progress_display()};
  const auto costs = vehicle_study::tune_laws(work, car);
  if (!costs.has_value()) {
    return refused(costs.error());
  }
  if (!costs.value()) {
    return stopped(output);
  }
  if (!settings().quiet) {
    app::print(stderr, "domain of the T-drift: {} draws at each speed and grip\n", options.draws);
  }
  const auto domain = tune::find_domain(car, options.draws, options.seed + 1, options.threads,
                                        [] { return !long_work::interrupted(); });
  if (!domain) {
    return stopped(output);
  }
  car.tuning.domain = *domain;
  const vehicle_study::TunedCar tuned{command_line(options), output.string(), car.tuning,
                                      *costs.value()};
  if (const auto problem = long_work::write_output(output, vehicle_study::tuning_file_of(tuned))) {
    return refused(*problem);
  }
  vehicle_study::remove_journals(work);
  if (options.as_json) {
    app::print_json(vehicle_study::json_of(tuned));
  } else {
    app::print("{}", vehicle_study::text_of(tuned));
  }
  return success;
}

int tune_car(TuneOptions options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto car_file = find_car(places.value(), options.car);
  if (!car_file.has_value()) {
    return refused(car_file.error());
  }
  const fs::path usual = prepare::tuning_path(car_file.value());
  if (options.from.empty()) {
    options.from = fs::exists(usual) ? options.car : TuneOptions{}.car;
  }
  const fs::path output = options.output.empty() ? usual : fs::path(options.output);
  const auto from = find_car(places.value(), options.from);
  if (!from.has_value()) {
    return refused(from.error());
  }
  const auto start =
      vehicle_study::read_start(car_file.value(), prepare::tuning_path(from.value()));
  if (!start.has_value()) {
    return refused(start.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({output})) {
    return refused(*problem);
  }
  return find_tuning(options, output, start.value());
}

}  // namespace

void add_tune(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "tune", "Find the numbers with which the controllers drive a car; can be interrupted");
  const auto options = std::make_shared<TuneOptions>();
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option(
      "--from", options->from,
      "Begin with the tuning of this car (default: its own, else compact_rwd_ev's)");
  command->add_option("--output", options->output, "Default: beside the car, NAME.tuning.toml");
  command->add_option("--swerve-evaluations", options->swerve_evaluations, "At most")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command->add_option("--drift-evaluations", options->drift_evaluations, "At most")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command->add_option("--draws", options->draws, "For the domain of the T-drift")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Same seed, same tuning")->capture_default_str();
  add_threads(*command, options->threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = tune_car(*options); });
}

}  // namespace saca::app

#include "apps/saca/options.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/vehicle_study/tuning_report.h"

namespace saca::app {
namespace {

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

/// Finds the tuning of a car that begins with another one's, and writes it.
void find_tuning(const TuneOptions& options, const fs::path& output, manoeuvre::Car car) {
  const std::string interrupted = fmt::format(
      "interrupted; {} was not written. The same command goes on where this one stopped.",
      output.string());
  const vehicle_study::TuningWork work{.program = "saca " SACA_VERSION,
                                       .car = options.car,
                                       .swerve_evaluations = options.swerve_evaluations,
                                       .drift_evaluations = options.drift_evaluations,
                                       .seed = options.seed,
                                       .threads = options.threads,
                                       .output = output,
                                       .display = here().display};
  const auto costs = need_whole(vehicle_study::tune_car(work, options.draws, car), interrupted);
  const vehicle_study::TunedCar tuned{command_line(options), output.string(), car.tuning, costs};
  write(output, vehicle_study::tuning_file_of(tuned));
  vehicle_study::remove_journals(work);
  tell(options.as_json, vehicle_study::json_of(tuned), vehicle_study::text_of(tuned));
}

void tune_car(const TuneOptions& given) {
  TuneOptions options = given;
  const fs::path car = need(installation::find_car(here(), options.car));
  const fs::path usual = prepare::tuning_path(car);
  if (options.from.empty()) {
    options.from = fs::exists(usual) ? options.car : TuneOptions{}.car;
  }
  const fs::path from = need(installation::find_car(here(), options.from));
  const auto start = need(vehicle_study::read_start(car, prepare::tuning_path(from)));
  const fs::path output = options.output.empty() ? usual : fs::path(options.output);
  need_distinct({{"--output", output}}, {{"--car", car}});
  need_writable({output});
  find_tuning(options, output, start);
}

}  // namespace

void add_tune(CLI::App& line) {
  const auto [command, options] = add_command<TuneOptions>(
      line, "tune", "Find the numbers with which the controllers drive a car; can be interrupted",
      tune_car);
  add_car(command, options.car);
  add(command, "--from", options.from,
      "Begin with the tuning of this car (default: its own, else compact_rwd_ev's)");
  add(command, "--output", options.output, "Default: beside the car, NAME.tuning.toml");
  add(command, "--swerve-evaluations", options.swerve_evaluations, "At most",
      CLI::Range(1, 10'000'000));
  add(command, "--drift-evaluations", options.drift_evaluations, "At most",
      CLI::Range(1, 10'000'000));
  add(command, "--draws", options.draws, "For the domain of the T-drift", CLI::Range(1, 1'000'000));
  add(command, "--seed", options.seed, "Same seed, same tuning");
  add_threads(command, options.threads);
  add_json(command, options.as_json);
}

}  // namespace saca::app

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/prepare/tuning_file.h"
#include "saca/lab/prepare/vehicle_file.h"
#include "saca/lab/tune/minimise.h"
#include "saca/lab/tune/trials.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using manoeuvre::Car;
using tune::Trial;

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

/// Of the car's parameters: with others, costs that were worked out before are worth nothing.
std::uint64_t digest(const vehicle::Vehicle& car) {
  Fnv hash;
  for (const double number : std::bit_cast<std::array<double, sizeof car / sizeof(double)>>(car)) {
    hash.add(std::bit_cast<std::uint64_t>(number));
  }
  return hash.value();
}

/// Makes one law good at its trials.
/// @return  its cost; nullopt: interrupted
template <class Law, std::size_t n>
Result<std::optional<double>> tune_law(const TuneOptions& options, const std::string& what,
                                       const std::array<manoeuvre::Number<Law>, n>& numbers,
                                       Law manoeuvre::Tuning::*law,
                                       const std::vector<Trial>& trials,
                                       double (*cost)(const Car&, const Trial&), int evaluations,
                                       const fs::path& journal, Car& car) {
  const auto with = [&](const std::vector<double>& x) {
    Car changed = car;
    for (std::size_t i = 0; i < n; ++i) {
      changed.tuning.*law.*numbers[i].member = x[i];
    }
    return changed;
  };
  tune::Problem problem{
      .name =
          fmt::format("saca {}: {} of {} ({:016x})", SACA_VERSION, what, options.car, digest(car)),
      .cost = [&](auto& x) { return tune::total_cost(with(x), trials, cost, options.threads); }};
  for (const auto& number : numbers) {
    problem.low.push_back(number.min);
    problem.high.push_back(number.max);
    problem.start.push_back(car.tuning.*law.*number.member);
  }
  SteadyClock clock;
  long_work::ProgressLine line(what, evaluations, clock, progress_display());
  int remembered = 0;
  const auto found = tune::minimise(
      problem, {evaluations, options.seed}, journal, [&](const tune::Progress& progress) {
        remembered += progress.remembered ? 1 : 0;
        line.show(progress.evaluations, remembered,
                  fmt::format(" evaluations, best {:.4f}", progress.best));
        return !long_work::interrupted();
      });
  if (!found.has_value()) {
    return found.error();
  }
  if (!found.value()) {
    return std::optional<double>();
  }
  car = with(found.value()->at);
  return std::optional(found.value()->cost);
}

/// The car with the tuning to begin with.
Result<Car> read_start(const fs::path& car_file, const fs::path& tuning_file) {
  const auto parameters = prepare::read_vehicle(car_file);
  if (!parameters.has_value()) {
    return parameters.error();
  }
  const auto tuning = prepare::read_tuning(tuning_file);
  if (!tuning.has_value()) {
    return tuning.error();
  }
  return Car{parameters.value(), tuning.value()};
}

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

/// Exit code for a law that was not found: it failed, or was interrupted.
int not_tuned(const Result<std::optional<double>>& cost, const fs::path& output) {
  return cost.has_value() ? stopped(output) : refused(cost.error());
}

int tune_car(TuneOptions options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto found = find_car(places.value(), options.car);
  if (!found.has_value()) {
    return refused(found.error());
  }
  const fs::path& car_file = found.value();
  if (options.from.empty()) {
    const bool tuned = fs::exists(prepare::tuning_path(car_file));
    options.from = tuned ? options.car : TuneOptions{}.car;
  }
  const fs::path output =
      options.output.empty() ? prepare::tuning_path(car_file) : fs::path(options.output);
  const auto from = find_car(places.value(), options.from);
  if (!from.has_value()) {
    return refused(from.error());
  }
  const auto start = read_start(car_file, prepare::tuning_path(from.value()));
  if (!start.has_value()) {
    return refused(start.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({output})) {
    return refused(*problem);
  }
  Car car = start.value();
  long_work::watch_for_interrupt();

  const fs::path swerve_journal = output.string() + ".swerve.journal";
  const fs::path drift_journal = output.string() + ".drift.journal";
  const auto swerve = tune_law(options, "lane change", manoeuvre::swerve_numbers,
                               &manoeuvre::Tuning::swerve, tune::swerve_trials(options.seed),
                               tune::swerve_cost, options.swerve_evaluations, swerve_journal, car);
  if (!swerve.has_value() || !swerve.value()) {
    return not_tuned(swerve, output);
  }
  const auto drift = tune_law(options, "T-drift", manoeuvre::drift_numbers,
                              &manoeuvre::Tuning::drift, tune::drift_trials(options.seed),
                              tune::drift_cost, options.drift_evaluations, drift_journal, car);
  if (!drift.has_value() || !drift.value()) {
    return not_tuned(drift, output);
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

  const std::string comment = fmt::format(
      "Made by: {}\nCosts: lane change {:.4f}, T-drift {:.4f} (saca/lab/tune/trials.h).",
      command_line(options), *swerve.value(), *drift.value());
  if (auto problem = long_work::write_output(output, prepare::tuning_text(car.tuning, comment))) {
    return refused(*problem);
  }
  fs::remove(swerve_journal);
  fs::remove(drift_journal);
  if (options.as_json) {
    app::print_json(nlohmann::json{{"schema", "saca.tune/1"},
                                   {"output", output.string()},
                                   {"swerve_cost", *swerve.value()},
                                   {"drift_cost", *drift.value()},
                                   {"drift_grip", manoeuvre::DriftDomain::grips},
                                   {"drift_slowest_mps", car.tuning.domain.slowest},
                                   {"drift_fastest_mps", car.tuning.domain.fastest}});
  } else {
    app::print("{}: lane change {:.4f}, T-drift {:.4f}\n", output.string(), *swerve.value(),
               *drift.value());
  }
  return success;
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
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = tune_car(*options); });
}

}  // namespace saca::app

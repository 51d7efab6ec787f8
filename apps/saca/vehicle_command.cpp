#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/base/core/names.h"
#include "saca/base/core/units.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/vehicle_file.h"
#include "saca/lab/tune/fit_car_file.h"
#include "saca/lab/tune/fit_drive.h"
#include "saca/lab/tune/fit_vehicle.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct FitOptions {
  std::vector<std::string> logs;
  std::string car;
  std::string output;
  double grip = 0.9;
  bool force = false;
  bool as_json = false;
};

struct TestDriveOptions {
  std::string car = "compact_rwd_ev";
  std::string kind;
  std::string output;
  double steering_deg = 2.0;
  tune::TestDrive drive;
};

json fit_json(const FitOptions& options, const tune::VehicleFit& fit) {
  json parameters = json::array();
  for (const tune::FittedParameter& one : fit.parameters) {
    const auto bound = [&one](double value) { return one.determined ? json(value) : json(); };
    parameters.push_back({{"section", one.section},
                          {"key", one.key},
                          {"base", one.base},
                          {"value", one.value},
                          {"determined", one.determined},
                          {"low", bound(one.low)},
                          {"high", bound(one.high)}});
  }
  json signals = json::array();
  for (const tune::SignalQuality& one : fit.signals) {
    signals.push_back({{"log", one.log},
                       {"column", tune::info(one.signal).column},
                       {"noise", one.noise},
                       {"rms", one.rms},
                       {"offset", one.offset},
                       {"run", one.run},
                       {"outliers", one.num_outliers}});
  }
  return {{"schema", "saca.vehicle_fit/1"}, {"car", options.car}, {"output", options.output},
          {"parameters", parameters},       {"signals", signals}, {"condition", fit.condition},
          {"warnings", fit.warnings}};
}

void print_fit(const FitOptions& options, const tune::VehicleFit& fit) {
  app::print("{:<26} {:>9} {:>9}   {}\n", "parameter", "base", "fitted", "95 % interval");
  for (const tune::FittedParameter& one : fit.parameters) {
    const std::string name = fmt::format("{}.{}", one.section, one.key);
    if (one.determined) {
      app::print("{:<26} {:>9.4g} {:>9.4g}   {:.4g} to {:.4g}\n", name, one.base, one.value,
                 one.low, one.high);
    } else {
      app::print("{:<26} {:>9.4g} {:>9}   the logs do not determine it\n", name, one.base, "-");
    }
  }
  app::print("\n{:<26} {:>9} {:>9} {:>9}   {}\n", "signal", "rms", "noise", "offset", "log");
  for (const tune::SignalQuality& one : fit.signals) {
    app::print("{:<26} {:>9.2g} {:>9.2g} {:>9.2g}   {}\n", tune::info(one.signal).column, one.rms,
               one.noise, one.offset, one.log);
  }
  app::print("\n{}: the car as fitted; the grip is the road's and not in it\n", options.output);
}

bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code problem;
  return fs::equivalent(one, other, problem);  // false where one of them is not there
}

int refuse(const std::string& message, ExitCode code) {
  complain(message);
  return code;
}

int fit_car(const FitOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refuse(places.error().message, bad_input);
  }
  const auto found = find_car(places.value(), options.car);
  if (!found.has_value()) {
    return refused(found.error());
  }
  const fs::path& base = found.value();
  if (is_same_file(options.output, base) && !options.force) {
    return refuse(fmt::format("--output: {} is the base itself; want another name, or --force",
                              options.output),
                  wrong_command_line);
  }
  const auto text = read_file(base);
  if (!text.has_value()) {
    return refuse(text.error().message, bad_input);
  }
  const auto car = prepare::parse_vehicle(text.value(), base.string());
  if (!car.has_value()) {
    return refuse(car.error().message, bad_input);
  }
  std::vector<tune::Log> logs;
  std::string names;
  for (const std::string& name : options.logs) {
    if (is_same_file(options.output, name)) {
      return refuse(fmt::format("--output: {} is a log", options.output), wrong_command_line);
    }
    const auto csv = read_file(name);
    if (!csv.has_value()) {
      return refuse(csv.error().message, bad_input);
    }
    auto log = tune::read_log(csv.value(), name, car.value());
    if (!log.has_value()) {
      return refuse(log.error().message, bad_input);
    }
    logs.push_back(std::move(log).value());
    names += (names.empty() ? "" : ", ") + fs::path(name).filename().string();
  }

  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const tune::VehicleFit fit = tune::fit_vehicle(car.value(), options.grip, logs);
  const auto fitted = tune::fitted_car_file(text.value(), base.string(), names, fit);
  if (!fitted.has_value()) {
    return refuse(fitted.error().message, bad_input);
  }
  if (const auto problem = long_work::write_output(options.output, fitted.value())) {
    return refuse(problem->message, cannot_write);
  }
  if (options.as_json) {
    app::print_json(fit_json(options, fit));
  } else {
    print_fit(options, fit);
  }
  for (const std::string& warning : fit.warnings) {
    app::print(stderr, "saca: warning: {}\n", warning);
  }
  return success;
}

int drive_test(const TestDriveOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refuse(places.error().message, bad_input);
  }
  const auto file = find_car(places.value(), options.car);
  if (!file.has_value()) {
    return refused(file.error());
  }
  const auto car = prepare::read_vehicle(file.value());
  if (!car.has_value()) {
    return refuse(car.error().message, bad_input);
  }
  tune::TestDrive drive = options.drive;
  drive.kind = options.kind == "brake" ? tune::TestKind::brake : tune::TestKind::steer;
  drive.steering = from_degrees(options.steering_deg);
  const tune::Log log = tune::drive_test(car.value(), drive);
  if (const auto problem = long_work::write_output(options.output, tune::write_log(log))) {
    return refuse(problem->message, cannot_write);
  }
  app::print("{}: {} of {} rows\n", options.output, name_of(log.kind, tune::kind_names),
             log.time.size());
  return success;
}

void add_fit(CLI::App& command, int& exit_code) {
  CLI::App* const fit = command.add_subcommand(
      "fit", "Fit a car's parameters to its own brake tests and step steers");
  const auto options = std::make_shared<FitOptions>();
  fit->add_option("logs", options->logs, "CSV files, all of one road (docs/formats.md)")
      ->required();
  fit->add_option("--car", options->car, "The car to begin with: a file, or a shipped one's name")
      ->required();
  fit->add_option("--output", options->output, "The fitted car's file")->required();
  fit->add_option("--grip", options->grip, "Of the road, as far as known; it is fitted too")
      ->check(within(0.1, 1.2, "-"))
      ->capture_default_str();
  fit->add_flag("--force", options->force, "Write over the base");
  fit->add_flag("--json", options->as_json, "For programs");
  fit->callback([options, &exit_code] { exit_code = fit_car(*options); });
}

void add_test_drive(CLI::App& command, int& exit_code) {
  CLI::App* const drive = command.add_subcommand(
      "test-drive", "Log a test that the model drives: what would a fit of such a test find?");
  const auto options = std::make_shared<TestDriveOptions>();
  drive->add_option("kind", options->kind, "brake or steer")
      ->required()
      ->check(one_of({"brake", "steer"}));
  drive->add_option("--car", options->car, "A file, or a shipped car's name")
      ->capture_default_str();
  drive->add_option("--output", options->output, "The log, a CSV file")->required();
  drive->add_option("--speed-mps", options->drive.speed)
      ->check(within(6.0, 60.0, "m/s"))
      ->capture_default_str();
  drive->add_option("--grip", options->drive.grip)
      ->check(within(0.1, 1.2, "-"))
      ->capture_default_str();
  drive->add_option("--deceleration-mps2", options->drive.deceleration, "Wanted of a brake test")
      ->check(within(1.0, 20.0))
      ->capture_default_str();
  drive->add_option("--steering-deg", options->steering_deg, "A step steer's, > 0 to the left")
      ->check(within(-15.0, 15.0))
      ->capture_default_str();
  drive->add_option("--noise", options->drive.noise, "Over that of usual sensors")
      ->check(within(0.0, 100.0))
      ->capture_default_str();
  drive->add_option("--seed", options->drive.seed, "Of the noise")->capture_default_str();
  drive->callback([options, &exit_code] { exit_code = drive_test(*options); });
}

}  // namespace

void add_vehicle(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("vehicle", "Somebody's own car");
  command->require_subcommand(1);
  add_fit(*command, exit_code);
  add_test_drive(*command, exit_code);
}

}  // namespace saca::app

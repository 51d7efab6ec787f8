#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
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
#include "saca/lab/tune/fit_drive.h"
#include "saca/lab/vehicle_study/car_fit.h"
#include "saca/lab/vehicle_study/fit_report.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

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

bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code problem;
  return fs::equivalent(one, other, problem);  // false where one of them is not there
}

/// The logs of a fit, in order.
/// @return  nullopt: one of them is the output
Result<std::optional<std::vector<tune::Log>>> read_logs(const FitOptions& options,
                                                        const vehicle::Vehicle& car) {
  std::vector<tune::Log> logs;
  for (const std::string& name : options.logs) {
    if (is_same_file(options.output, name)) {
      return std::optional<std::vector<tune::Log>>();
    }
    const auto csv = read_file(name);
    if (!csv.has_value()) {
      return csv.error();
    }
    auto log = tune::read_log(csv.value(), name, car);
    if (!log.has_value()) {
      return log.error();
    }
    logs.push_back(std::move(log).value());
  }
  return std::optional(std::move(logs));
}

/// Fits, writes the fitted car's file, and tells of it.
int fit_and_tell(const FitOptions& options, const vehicle_study::BaseCar& base,
                 const std::vector<tune::Log>& logs) {
  const auto fitted = vehicle_study::fit_car(base, options.grip, logs);
  if (!fitted.has_value()) {
    return refused(fitted.error());
  }
  if (const auto problem = long_work::write_output(options.output, fitted.value().file)) {
    return refused(*problem);
  }
  const vehicle_study::FitResult result{options.car, options.output, fitted.value().fit};
  if (options.as_json) {
    app::print_json(vehicle_study::json_of(result));
  } else {
    app::print("{}", vehicle_study::text_of(result));
  }
  for (const std::string& warning : result.fit.warnings) {
    app::print(stderr, "saca: warning: {}\n", warning);
  }
  return success;
}

int fit_car(const FitOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto file = find_car(places.value(), options.car);
  if (!file.has_value()) {
    return refused(file.error());
  }
  if (is_same_file(options.output, file.value()) && !options.force) {
    complain(fmt::format("--output: {} is the base itself; want another name, or --force",
                         options.output));
    return wrong_command_line;
  }
  const auto base = vehicle_study::read_base(file.value());
  if (!base.has_value()) {
    return refused(base.error());
  }
  const auto logs = read_logs(options, base.value().car);
  if (!logs.has_value()) {
    return refused(logs.error());
  }
  if (!logs.value()) {
    complain(fmt::format("--output: {} is a log", options.output));
    return wrong_command_line;
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  return fit_and_tell(options, base.value(), *logs.value());
}

int drive_test(const TestDriveOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto file = find_car(places.value(), options.car);
  if (!file.has_value()) {
    return refused(file.error());
  }
  const auto car = prepare::read_vehicle(file.value());
  if (!car.has_value()) {
    return refused(car.error());
  }
  tune::TestDrive drive = options.drive;
  drive.kind = options.kind == "brake" ? tune::TestKind::brake : tune::TestKind::steer;
  drive.steering = from_degrees(options.steering_deg);
  const tune::Log log = tune::drive_test(car.value(), drive);
  if (const auto problem = long_work::write_output(options.output, tune::write_log(log))) {
    return refused(*problem);
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

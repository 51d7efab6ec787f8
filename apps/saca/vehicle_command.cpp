#include "apps/saca/options.h"
#include "saca/base/core/names.h"
#include "saca/base/core/units.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/prepare/vehicle_file.h"
#include "saca/lab/tune/fit_drive.h"
#include "saca/lab/vehicle_study/car_fit.h"
#include "saca/lab/vehicle_study/fit_report.h"

namespace saca::app {
namespace {

struct FitOptions {
  std::vector<std::string> logs;
  std::string car;
  std::string output;
  double grip = 0.9;
  bool force = false;
  bool as_json = false;
};

void fit_car(const FitOptions& options) {
  const fs::path file = need(installation::find_car(here(), options.car));
  if (is_same_file(options.output, file) && !options.force) {
    refuse(wrong_command_line,
           fmt::format("--output: {} is the base itself; want another name, or --force",
                       options.output));
  }
  for (const std::string& log : options.logs) {
    if (is_same_file(options.output, log)) {
      refuse(wrong_command_line, fmt::format("--output: {} is a log", options.output));
    }
  }
  const auto base = need(vehicle_study::read_base(file));
  const auto logs = need(vehicle_study::read_logs(options.logs, base.car));
  need_writable({options.output});
  const auto fitted = need(vehicle_study::fit_car(base, options.grip, logs));
  write(options.output, fitted.file);
  const vehicle_study::FitResult result{options.car, options.output, fitted.fit};
  tell(options.as_json, vehicle_study::json_of(result), vehicle_study::text_of(result));
  for (const std::string& warning : result.fit.warnings) {
    complain("warning: " + warning);
  }
}

void add_fit(CLI::App& vehicle) {
  const auto [fit, options] = add_command<FitOptions>(
      vehicle, "fit", "Fit a car's parameters to its own brake tests and step steers", fit_car);
  add_needed(fit, "logs", options.logs, "CSV files, all of one road (docs/formats.md)");
  add_needed(fit, "--car", options.car, "The car to begin with: a file, or a shipped one's name");
  add_needed(fit, "--output", options.output, "The fitted car's file");
  add(fit, "--grip", options.grip, "Of the road, as far as known; it is fitted too",
      within(0.1, 1.2, "-"));
  fit.add_flag("--force", options.force, "Write over the base");
  add_json(fit, options.as_json);
}

struct TestDriveOptions {
  std::string car = "compact_rwd_ev";
  std::string kind;
  std::string output;
  double steering_deg = 2.0;
  tune::TestDrive drive;
};

void drive_test(const TestDriveOptions& options) {
  const fs::path file = need(installation::find_car(here(), options.car));
  need_distinct({{"--output", options.output}}, {{"--car", file}});
  const auto car = need(prepare::read_vehicle(file));
  tune::TestDrive drive = options.drive;
  drive.kind = options.kind == "brake" ? tune::TestKind::brake : tune::TestKind::steer;
  drive.steering = from_degrees(options.steering_deg);
  const tune::Log log = tune::drive_test(car, drive);
  write(options.output, tune::write_log(log));
  app::print("{}: {} of {} rows\n", options.output, name_of(log.kind, tune::kind_names),
             log.time.size());
}

void add_test_drive(CLI::App& vehicle) {
  const auto [drive, options] = add_command<TestDriveOptions>(
      vehicle, "test-drive",
      "Log a test that the model drives: what would a fit of such a test find?", drive_test);
  add_needed(drive, "kind", options.kind, "brake or steer", one_of({"brake", "steer"}));
  add(drive, "--car", options.car, "A file, or a shipped car's name");
  add_needed(drive, "--output", options.output, "The log, a CSV file");
  add(drive, "--speed-mps", options.drive.speed, "", within(6.0, 60.0, "m/s"));
  add(drive, "--grip", options.drive.grip, "", within(0.1, 1.2, "-"));
  add(drive, "--deceleration-mps2", options.drive.deceleration, "Wanted of a brake test",
      within(1.0, 20.0));
  add(drive, "--steering-deg", options.steering_deg, "A step steer's, > 0 to the left",
      within(-15.0, 15.0));
  add(drive, "--noise", options.drive.noise, "Over that of usual sensors", within(0.0, 100.0));
  add(drive, "--seed", options.drive.seed, "Of the noise");
}

}  // namespace

void add_vehicle(CLI::App& line) {
  CLI::App& vehicle = add_group(line, "vehicle", "Somebody's own car");
  add_fit(vehicle);
  add_test_drive(vehicle);
}

}  // namespace saca::app

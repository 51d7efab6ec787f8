#include "apps/saca/options.h"
#include "saca/lab/report/record_page.h"
#include "saca/lab/vehicle_study/drive_study.h"

namespace saca::app {
namespace {

struct DriveOptions {
  std::optional<manoeuvre::PolicyId> policy;  ///< is there once the line is parsed
  vehicle_study::DriveQuestion question{.car = "compact_rwd_ev", .threads = usual_threads()};
  std::string report;
  bool as_json = false;
};

void drive(const DriveOptions& options) {
  vehicle_study::DriveQuestion question = options.question;
  question.policy = *options.policy;
  const auto car = need(installation::read_named_car(here(), question.car));
  need_distinct({{"--report", options.report}}, {car_file(question.car)});
  need_writable({options.report});
  report::DriveRecord driven =
      vehicle_study::record_of(question, "saca " SACA_VERSION, car.name, car.car);
  need(vehicle_study::drive_into(driven, question));
  const std::string record = report::drive_json(driven);
  app::print("{}", options.as_json ? record + "\n"
                                   : vehicle_study::text_of_drive(nlohmann::json::parse(record)));
  if (options.report.empty()) {
    return;
  }
  write(options.report, need(report::drive_report(record)));
  if (!options.as_json) {
    app::print("Report: {}\n", fs::absolute(options.report).string());
  }
}

}  // namespace

void add_drive(CLI::App& line) {
  const auto [command, options] = add_command<DriveOptions>(
      line, "drive", "Drive one manoeuvre on an empty road, and show it", drive);
  vehicle_study::DriveQuestion& question = options.question;
  add_policy(command, options.policy, "Its number, 0 to 7, or its name")->required();
  add(command, "--speed", question.speed, "At the start [m/s]", within(0.0, 100.0, "m/s"));
  add(command, "--grip", question.grip, "Friction coefficient of the road", within(0.01, 1.2, "-"));
  add_target_speed(command, question.target_speed);
  add_strength(command, question.strength, ", 0.2 to 1");
  add_car(command, question.car);
  add(command, "--seconds", question.seconds,
      "Watch it no longer than this (default: 30, of policy 7: 3)", within(0.01, 600.0, "s"));
  add(command, "--draws", question.draws,
      "Again so many times, with grip, mass, lags, ... not as the controller thinks",
      CLI::Range(0, 1'000'000));
  add(command, "--seed", question.seed, "Of the draws");
  add_threads(command, question.threads);
  add(command, "--report", options.report, "Write an HTML page that shows it");
  add_json(command, options.as_json, "Print the record, for programs");
}

}  // namespace saca::app

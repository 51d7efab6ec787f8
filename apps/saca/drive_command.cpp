#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/report/record_page.h"
#include "saca/lab/vehicle_study/drive_study.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct DriveOptions {
  std::optional<manoeuvre::PolicyId> policy;  ///< is there once the line is parsed
  vehicle_study::DriveQuestion question{.car = "compact_rwd_ev", .threads = usual_threads()};
  std::string report;
  bool as_json = false;
};

std::optional<Error> write_report(const std::string& file, const std::string& record) {
  const auto page = report::drive_report(record);
  if (!page.has_value()) {
    return page.error();
  }
  return long_work::write_output(file, page.value());
}

/// Prints a record, and writes its page where one is wanted.
int show(const DriveOptions& options, const std::string& record) {
  if (options.as_json) {
    app::print("{}\n", record);
  } else {
    app::print("{}", vehicle_study::text_of_drive(nlohmann::json::parse(record)));
  }
  if (options.report.empty()) {
    return success;
  }
  if (const auto problem = write_report(options.report, record)) {
    complain(problem->message);
    return cannot_write;
  }
  if (!options.as_json) {
    app::print("Report: {}\n", fs::absolute(options.report).string());
  }
  return success;
}

int drive(const DriveOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  vehicle_study::DriveQuestion question = options.question;
  question.policy = *options.policy;
  const auto file = find_car(places.value(), question.car);
  if (!file.has_value()) {
    return refused(file.error());
  }
  const auto car = prepare::read_car(file.value());
  if (!car.has_value()) {
    return refused(car.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.report})) {
    return refused(*problem);
  }
  report::DriveRecord record = vehicle_study::record_of(question, "saca " SACA_VERSION,
                                                        file.value().stem().string(), car.value());
  if (const auto problem = vehicle_study::drive_into(record, question)) {
    return refused(*problem);
  }
  return show(options, report::drive_json(record));
}

}  // namespace

void add_drive(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("drive", "Drive one manoeuvre on an empty road, and show it");
  const auto options = std::make_shared<DriveOptions>();
  add_policy(*command, options->policy, "Its number, 0 to 7, or its name")->required();
  command->add_option("--speed", options->question.speed, "At the start [m/s]")
      ->check(within(0.0, 100.0, "m/s"))
      ->capture_default_str();
  command->add_option("--grip", options->question.grip, "Friction coefficient of the road")
      ->check(within(0.01, 1.2, "-"))
      ->capture_default_str();
  add_target_speed(*command, options->question.target_speed);
  command
      ->add_option("--strength", options->question.strength,
                   "Of policy 0: share of the grip that the brakes are asked for, 0.2 to 1 "
                   "(default: all)")
      ->check(within(manoeuvre::least_strength, 1.0, "-"));
  command->add_option("--car", options->question.car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command
      ->add_option("--seconds", options->question.seconds,
                   "Watch it no longer than this (default: 30, of policy 7: 3)")
      ->check(within(0.01, 600.0, "s"));
  command
      ->add_option("--draws", options->question.draws,
                   "Again so many times, with grip, mass, lags, ... not as the controller thinks")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->question.seed, "Of the draws")->capture_default_str();
  add_threads(*command, options->question.threads);
  command->add_option("--report", options->report, "Write an HTML page that shows it");
  command->add_flag("--json", options->as_json, "Print the record, for programs");
  command->callback([options, &exit_code] { exit_code = drive(*options); });
}

}  // namespace saca::app

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/units.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/report/drive_json.h"
#include "saca/lab/report/record_page.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct DriveOptions {
  std::optional<manoeuvre::PolicyId> policy;  ///< is there once the line is parsed
  double speed = 14.0;
  double grip = 0.9;
  std::optional<double> target_speed;
  std::optional<double> strength;
  std::string car = "compact_rwd_ev";
  std::optional<double> seconds;
  int draws = 0;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  std::string report;
  bool as_json = false;
};

manoeuvre::Plan plan_of(const DriveOptions& options) {
  manoeuvre::Plan plan = manoeuvre::default_plan(*options.policy, options.speed);
  if (options.target_speed) {
    plan.target_speed = options.target_speed;
  }
  plan.strength = options.strength;
  return plan;
}

/// How long it is watched when it does not end by itself [s].
double horizon_of(const DriveOptions& options) {
  const bool ends = options.policy != manoeuvre::PolicyId::no_intervention;
  return options.seconds.value_or(ends ? 30.0 : 3.0);
}

std::string command_line(const DriveOptions& options) {
  std::string line =
      fmt::format("saca drive --policy {} --speed {:g} --grip {:g} --car {}",
                  manoeuvre::index(*options.policy), options.speed, options.grip, options.car);
  line += options.target_speed ? fmt::format(" --target-speed {:g}", *options.target_speed) : "";
  line += options.strength ? fmt::format(" --strength {:g}", *options.strength) : "";
  line += options.seconds ? fmt::format(" --seconds {:g}", *options.seconds) : "";
  line +=
      options.draws > 0 ? fmt::format(" --draws {} --seed {}", options.draws, options.seed) : "";
  return line;
}

/// A size with its side in words, e.g. "1.48 m to the right".
/// @param left  > 0 to the left
std::string sided(double left, int digits, const char* unit) {
  const std::string size = fmt::format("{:.{}f}", std::abs(left), digits);
  const bool is_none = size.find_first_not_of("0.") == std::string::npos;
  return size + " " + unit + (is_none ? "" : left > 0.0 ? " to the left" : " to the right");
}

/// For people: what the record says of the end, and of the draws.
void tell(const json& record) {
  const json& end = record["end"];
  app::print("{} from {:g} m/s on grip {:g} with {}: {} after {:.2f} s\n",
             record["policy"]["name"].get<std::string>(),
             record["start"]["speed_mps"].get<double>(), record["road"]["grip"].get<double>(),
             record["car"]["name"].get<std::string>(), end["state"].get<std::string>(),
             end["time_s"].get<double>());
  app::print("  centre of mass {:.2f} m forward, {}; heading {}, {:.1f} m/s\n",
             end["forward_m"].get<double>(), sided(end["sideways_m"].get<double>(), 2, "m"),
             sided(end["heading_deg"].get<double>(), 1, "deg"), end["speed_mps"].get<double>());
  const json& draws = record["draws"];
  if (draws.is_null()) {
    return;
  }
  app::print("  {} draws of what the controller does not know (left is positive):\n",
             draws["count"].get<int>());
  if (const json& across = draws["within_10_deg"]; !across.is_null()) {
    app::print("    within 10 deg of across the lane: {:.1f} % (95 % interval {:.1f} to {:.1f})\n",
               100.0 * across["share"].get<double>(), 100.0 * across["low"].get<double>(),
               100.0 * across["high"].get<double>());
  }
  for (const auto& [key, what] : {std::pair{"time_s", "time, s"},
                                  {"forward_m", "forward, m"},
                                  {"sideways_m", "aside, m"},
                                  {"heading_deg", "heading, deg"}}) {
    const json& spread = draws[key];
    app::print("    {:16} p05 {:8.2f}   p50 {:8.2f}   p95 {:8.2f}\n", what,
               spread["p05"].get<double>(), spread["p50"].get<double>(),
               spread["p95"].get<double>());
  }
}

std::optional<Error> write_report(const std::string& file, const std::string& record) {
  const auto page = report::drive_report(record);
  if (!page.has_value()) {
    return page.error();
  }
  return long_work::write_output(file, page.value());
}

int drive(const DriveOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    complain(places.error().message);
    return bad_input;
  }
  const auto found = find_car(places.value(), options.car);
  if (!found.has_value()) {
    return refused(found.error());
  }
  const fs::path& car_file = found.value();
  const auto car = prepare::read_car(car_file);
  if (!car.has_value()) {
    complain(car.error().message);
    return bad_input;
  }
  report::DriveRecord record{.program = "saca " SACA_VERSION,
                             .command = command_line(options),
                             .car_name = car_file.stem().string(),
                             .car = car.value(),
                             .plan = plan_of(options)};
  record.scene.ego.v_B = {options.speed, 0.0};
  record.scene.grip = options.grip;
  if (const auto problem = long_work::why_outputs_unwritable({options.report})) {
    return refused(*problem);
  }
  if (const auto refused = manoeuvre::refusal(record.car, record.plan, record.scene)) {
    complain(*refused);
    return bad_input;
  }
  report::ride_into(record, horizon_of(options));
  if (options.draws > 0) {
    constexpr int shown_paths = 50;
    record.draws = {.seed = options.seed,
                    .endings = tune::draw_endings(record.car, record.plan, record.scene,
                                                  options.grip, horizon_of(options), options.draws,
                                                  options.seed, shown_paths, options.threads)};
  }
  const std::string text = report::drive_json(record);
  if (options.as_json) {
    app::print("{}\n", text);
  } else {
    tell(json::parse(text));
  }
  if (options.report.empty()) {
    return success;
  }
  if (const auto problem = write_report(options.report, text)) {
    complain(problem->message);
    return cannot_write;
  }
  if (!options.as_json) {
    app::print("Report: {}\n", fs::absolute(options.report).string());
  }
  return success;
}

}  // namespace

void add_drive(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("drive", "Drive one manoeuvre on an empty road, and show it");
  const auto options = std::make_shared<DriveOptions>();
  add_policy(*command, options->policy, "Its number, 0 to 7, or its name")->required();
  command->add_option("--speed", options->speed, "At the start [m/s]")
      ->check(within(0.0, 100.0, "m/s"))
      ->capture_default_str();
  command->add_option("--grip", options->grip, "Friction coefficient of the road")
      ->check(within(0.01, 1.2, "-"))
      ->capture_default_str();
  add_target_speed(*command, options->target_speed);
  command
      ->add_option("--strength", options->strength,
                   "Of policy 0: share of the grip that the brakes are asked for, 0.2 to 1 "
                   "(default: all)")
      ->check(within(manoeuvre::least_strength, 1.0, "-"));
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command
      ->add_option("--seconds", options->seconds,
                   "Watch it no longer than this (default: 30, of policy 7: 3)")
      ->check(within(0.01, 600.0, "s"));
  command
      ->add_option("--draws", options->draws,
                   "Again so many times, with grip, mass, lags, ... not as the controller thinks")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the draws")->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--report", options->report, "Write an HTML page that shows it");
  command->add_flag("--json", options->as_json, "Print the record, for programs");
  command->callback([options, &exit_code] { exit_code = drive(*options); });
}

}  // namespace saca::app

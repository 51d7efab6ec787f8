#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/places.h"
#include "apps/saca/within.h"
#include "saca/core/file.h"
#include "saca/sim/hundred_car.h"
#include "saca/sim/traffic_recording.h"

namespace saca::app {
namespace {

struct ImportOptions {
  std::string path;
  sim::HundredCarRequest request;
  std::string output;
};

int import_hundred_car(const ImportOptions& options) {
  const auto imported = sim::import_hundred_car(options.path, options.request);
  if (!imported.has_value()) {
    complain(imported.error().message);
    return bad_input;
  }
  const std::string text = sim::write_scenario(imported.value().scenario);
  if (options.output.empty()) {
    fmt::print("{}", text);
    return success;
  }
  if (const auto problem = write_file(options.output, text)) {
    complain(problem->message);
    return cannot_write;
  }
  const sim::HundredCarReport& report = imported.value().report;
  fmt::print("{}: event {}, rows {} to {}; lead seen in {} rows, {} gaps bridged, {} outliers\n",
             options.output, options.request.event, report.first_row, report.last_row,
             report.lead.num_seen, report.lead.num_gaps, report.lead.num_outliers);
  return success;
}

struct TrafficOptions {
  std::string path;
  sim::TrafficRequest request;
  std::string output;
  bool as_json = false;
};

nlohmann::json traffic_json(const sim::TrafficImport& made, const TrafficOptions& options) {
  const sim::TrafficReport& report = made.report;
  const traffic::LaneFit& lane = report.lane;
  nlohmann::json actors = nlohmann::json::array();
  for (const sim::TrafficActor& actor : report.actors) {
    actors.push_back({{"name", actor.name}, {"obstacle", actor.obstacle}});
  }
  return {{"schema", "saca.traffic_import/1"},
          {"name", made.scenario.name},
          {"output", options.output},
          {"ego", options.request.ego ? nlohmann::json(*options.request.ego) : nlohmann::json()},
          {"from_s", report.from},
          {"duration_s", made.scenario.duration},
          {"origin_x_m", report.origin_W.x},
          {"origin_y_m", report.origin_W.y},
          {"lane",
           {{"lanelets", lane.lanelets},
            {"behind_m", lane.behind},
            {"ahead_m", lane.ahead},
            {"rms_m", lane.rms},
            {"largest_m", lane.largest},
            {"widened_left_m", report.widened_left},
            {"widened_right_m", report.widened_right}}},
          {"smoothing",
           {{"outliers", report.num_outliers},
            {"filled", report.num_filled},
            {"rms_shift_m", report.rms_shift},
            {"largest_shift_m", report.largest_shift},
            {"hardest_mps2", report.hardest}}},
          {"actors", actors},
          {"left_out", report.left_out},
          {"ignored", report.ignored}};
}

void tell(const sim::TrafficImport& made, const TrafficOptions& options) {
  const sim::TrafficReport& report = made.report;
  const traffic::LaneFit& lane = report.lane;
  fmt::print("{}: {} vehicles around {}, {:.1f} s\n", options.output, made.scenario.actors.size(),
             options.request.ego ? fmt::format("obstacle {}", *options.request.ego)
                                 : "the planning problem's start",
             made.scenario.duration);
  fmt::print("  lane: an arc over {:.0f} m ahead, {:.2f} m off rms, {:.2f} m at most\n", lane.ahead,
             lane.rms, lane.largest);
  fmt::print("  smoothing: {:.2f} m rms, {:.2f} m at most, {} outliers\n", report.rms_shift,
             report.largest_shift, report.num_outliers);
  for (const auto& [reason, count] : report.left_out) {
    fmt::print("  left out: {} {}\n", count, reason);
  }
  for (const auto& [element, count] : report.ignored) {
    fmt::print("  ignored: {} {}\n", count, element);
  }
}

int import_traffic(const TrafficOptions& options) {
  const auto imported = sim::import_commonroad(options.path, options.request);
  if (!imported.has_value()) {
    complain(imported.error().message);
    return bad_input;
  }
  const std::string text = sim::write_scenario(imported.value().scenario);
  const auto again = sim::read_scenario(text, options.output);
  if (!again.has_value()) {
    complain(again.error().message);
    return bad_input;
  }
  if (const auto problem = write_file(options.output, text)) {
    complain(problem->message);
    return cannot_write;
  }
  if (options.as_json) {
    fmt::print("{}\n", traffic_json(imported.value(), options).dump(1));
  } else {
    tell(imported.value(), options);
  }
  return success;
}

void add_commonroad(CLI::App& command, int& exit_code) {
  CLI::App* const traffic = command.add_subcommand(
      "commonroad", "Recorded traffic of a CommonRoad file (XML 2020a) around the ego");
  const auto options = std::make_shared<TrafficOptions>();
  traffic->add_option("file", options->path, "The file")->required();
  traffic->add_option("--ego", options->request.ego,
                      "Id of the obstacle whose place the ego takes; without it the ego begins at "
                      "the planning problem's start");
  traffic
      ->add_option("--from_s", options->request.from,
                   "Where in the file's time the scenario begins; without it where the ego does")
      ->check(within(0.0, 1e6));
  traffic
      ->add_option("--after_s", options->request.after,
                   "How long the scenario goes on after the recording, everybody straight on")
      ->check(within(0.0, 60.0))
      ->capture_default_str();
  traffic->add_option("--output", options->output, "The scenario file")->required();
  traffic->add_flag("--json", options->as_json, "For programs");
  traffic->callback([options, &exit_code] { exit_code = import_traffic(*options); });
}

}  // namespace

void add_import(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("import", "Make a scenario of a recording");
  command->require_subcommand(1);
  CLI::App* const study = command->add_subcommand(
      "100car", "A rear-end conflict of the 100-Car study: ego, lead and follower");
  const auto options = std::make_shared<ImportOptions>();
  study
      ->add_option("path", options->path,
                   "Folder of the release (timeseries/ and meta/), or one time-series file")
      ->required();
  study->add_option("--event", options->request.event, "Event id")->required();
  study->add_option("--before_s", options->request.before, "Kept before the conflict")
      ->check(within(1.0, 60.0))
      ->capture_default_str();
  study->add_option("--after_s", options->request.after, "Kept after the last evasive manoeuvre")
      ->check(within(0.0, 60.0))
      ->capture_default_str();
  study->add_option("--narrative", options->request.narrative, "The study's own words, quoted");
  study->add_option("--output", options->output, "The scenario file; without it, to the terminal");
  study->callback([options, &exit_code] { exit_code = import_hundred_car(*options); });
  add_commonroad(*command, exit_code);
}

}  // namespace saca::app

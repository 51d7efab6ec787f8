#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/importers/hundred_car.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/traffic_recording.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  std::string path;
  importers::HundredCarRequest request;
  bool all = false;
  std::string output;
  bool as_json = false;
};

int import_hundred_car(const ImportOptions& options) {
  const auto imported = importers::import_hundred_car(options.path, options.request);
  if (!imported.has_value()) {
    complain(imported.error().message);
    return bad_input;
  }
  const std::string text = scenario::write_scenario(imported.value().scenario);
  if (options.output.empty()) {
    app::print("{}", text);
    return success;
  }
  if (const auto problem = long_work::write_output(options.output, text)) {
    complain(problem->message);
    return cannot_write;
  }
  const importers::HundredCarReport& report = imported.value().report;
  app::print("{}: event {}, rows {} to {}; lead seen in {} rows, {} gaps bridged, {} outliers\n",
             options.output, options.request.event, report.first_row, report.last_row,
             report.lead.num_seen, report.lead.num_gaps, report.lead.num_outliers);
  return success;
}

/// Reads and rebuilds all events, with progress on the error stream.
Result<std::vector<importers::HundredCarOutcome>> all_hundred_cars(const ImportOptions& options) {
  long_work::watch_for_interrupt();
  SteadyClock clock;
  constexpr int percent = 100;
  long_work::ProgressLine line("import 100car", percent, clock, progress_display());
  return importers::import_hundred_cars(
      options.path, options.request, [&](std::size_t done, std::size_t all) {
        line.show(static_cast<int>(percent * done / all), 0, " percent");
        return !long_work::interrupted();
      });
}

/// The scenarios as files of a folder.
std::optional<Error> write_scenarios(const std::vector<importers::HundredCarOutcome>& outcomes,
                                     const fs::path& folder) {
  for (const importers::HundredCarOutcome& outcome : outcomes) {
    if (const importers::HundredCarImport* made = outcome.rebuilt()) {
      const fs::path file = folder / (made->scenario.name + ".toml");
      if (auto problem = long_work::write_output(file, scenario::write_scenario(made->scenario))) {
        return problem;
      }
    }
  }
  return std::nullopt;
}

nlohmann::json outcome_json(const importers::HundredCarOutcome& outcome) {
  nlohmann::json told{{"event", outcome.event}, {"severity", outcome.severity}};
  if (const importers::HundredCarRefusal* refusal = outcome.refusal()) {
    told["refused"] = name(refusal->reason);
    told["message"] = refusal->message;
    return told;
  }
  const importers::HundredCarReport& report = outcome.rebuilt()->report;
  told["scenario"] = outcome.rebuilt()->scenario.name;
  told["first_row"] = report.first_row;
  told["last_row"] = report.last_row;
  told["gyro_bias_degps"] = to_degrees(report.gyro_bias);
  told["curvature_1pm"] = report.curvature;
  told["lane_kept_s"] = report.kept_for;
  told["lane_rms_m"] = report.keeping_rms;
  return told;
}

void tell_all(const std::vector<importers::HundredCarOutcome>& outcomes, std::size_t num_rebuilt,
              bool as_json) {
  const auto refusals = importers::refusals(outcomes);
  if (as_json) {
    nlohmann::json reasons = nlohmann::json::object();
    for (const auto& [reason, count] : refusals) {
      reasons[std::string(name(reason))] = count;
    }
    nlohmann::json list = nlohmann::json::array();
    std::transform(outcomes.begin(), outcomes.end(), std::back_inserter(list), outcome_json);
    const nlohmann::json told{{"schema", "saca.hundred_car_import/1"},
                              {"events", outcomes.size()},
                              {"rebuilt", num_rebuilt},
                              {"refused", reasons},
                              {"list", list}};
    app::print_json(told);
    return;
  }
  app::print("{} events: {} rebuilt, {} refused\n", outcomes.size(), num_rebuilt,
             outcomes.size() - num_rebuilt);
  for (const auto& [reason, count] : refusals) {
    app::print("  {:5} {:24} {}\n", count, name(reason), meaning(reason));
  }
}

int import_all_hundred_cars(const ImportOptions& options) {
  const fs::path some_file =
      options.output.empty() ? fs::path() : fs::path(options.output) / "x.toml";
  if (const auto problem = long_work::why_outputs_unwritable({some_file})) {
    return refused(*problem);
  }
  const auto outcomes = all_hundred_cars(options);
  if (!outcomes.has_value()) {
    return long_work::interrupted() ? static_cast<int>(was_interrupted) : refused(outcomes.error());
  }
  if (!options.output.empty()) {
    if (const auto problem = write_scenarios(outcomes.value(), options.output)) {
      complain(problem->message);
      return cannot_write;
    }
  }
  const auto num_rebuilt = static_cast<std::size_t>(
      std::count_if(outcomes.value().begin(), outcomes.value().end(),
                    [](const auto& outcome) { return outcome.rebuilt() != nullptr; }));
  tell_all(outcomes.value(), num_rebuilt, options.as_json);
  return success;
}

struct TrafficOptions {
  std::string path;
  importers::TrafficRequest request;
  std::string output;
  bool as_json = false;
};

nlohmann::json traffic_json(const importers::TrafficImport& made, const TrafficOptions& options) {
  const importers::TrafficReport& report = made.report;
  const recordings::LaneFit& lane = report.lane;
  nlohmann::json actors = nlohmann::json::array();
  for (const importers::TrafficActor& actor : report.actors) {
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

void tell(const importers::TrafficImport& made, const TrafficOptions& options) {
  const importers::TrafficReport& report = made.report;
  const recordings::LaneFit& lane = report.lane;
  app::print("{}: {} vehicles around {}, {:.1f} s\n", options.output, made.scenario.actors.size(),
             options.request.ego ? fmt::format("obstacle {}", *options.request.ego)
                                 : "the planning problem's start",
             made.scenario.duration);
  app::print("  lane: an arc over {:.0f} m ahead, {:.2f} m off rms, {:.2f} m at most\n", lane.ahead,
             lane.rms, lane.largest);
  app::print("  smoothing: {:.2f} m rms, {:.2f} m at most, {} outliers\n", report.rms_shift,
             report.largest_shift, report.num_outliers);
  for (const auto& [reason, count] : report.left_out) {
    app::print("  left out: {} {}\n", count, reason);
  }
  for (const auto& [element, count] : report.ignored) {
    app::print("  ignored: {} {}\n", count, element);
  }
}

int import_traffic(const TrafficOptions& options) {
  const auto imported = importers::import_commonroad(options.path, options.request);
  if (!imported.has_value()) {
    complain(imported.error().message);
    return bad_input;
  }
  const std::string text = scenario::write_scenario(imported.value().scenario);
  const auto again = scenario::read_scenario(text, options.output);
  if (!again.has_value()) {
    complain(again.error().message);
    return bad_input;
  }
  if (const auto problem = long_work::write_output(options.output, text)) {
    complain(problem->message);
    return cannot_write;
  }
  if (options.as_json) {
    app::print_json(traffic_json(imported.value(), options));
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
      ->add_option("--from-s", options->request.from,
                   "Where in the file's time the scenario begins; without it where the ego does")
      ->check(within(0.0, 1e6));
  traffic
      ->add_option("--after-s", options->request.after,
                   "How long the scenario goes on after the recording, everybody straight on")
      ->check(within(0.0, 60.0, "s"))
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
  CLI::Option_group* const which = study->add_option_group("which");
  which->add_option("--event", options->request.event, "Event id");
  CLI::Option* const all =
      which->add_flag("--all", options->all, "Every event in or below the folder, with counts");
  which->require_option(1);
  study->add_option("--before-s", options->request.before, "Kept before the conflict")
      ->check(within(1.0, 60.0, "s"))
      ->capture_default_str();
  study->add_option("--after-s", options->request.after, "Kept after the last evasive manoeuvre")
      ->check(within(0.0, 60.0, "s"))
      ->capture_default_str();
  study->add_option("--narrative", options->request.narrative, "The study's own words, quoted")
      ->excludes(all);
  study->add_option("--output", options->output,
                    "The scenario file; without it, to the terminal. With --all a folder; without "
                    "it, only the counts are told");
  study->add_flag("--json", options->as_json, "The counts and every event's reason, for programs")
      ->needs(all);
  study->callback([options, &exit_code] {
    exit_code = options->all ? import_all_hundred_cars(*options) : import_hundred_car(*options);
  });
  add_commonroad(*command, exit_code);
}

}  // namespace saca::app

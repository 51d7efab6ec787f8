#include <cstddef>
#include <filesystem>
#include <memory>
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
#include "saca/lab/importers/hundred_car.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/import_json.h"
#include "saca/lab/importers/import_text.h"
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
  app::print("{}",
             importers::import_text(imported.value().report, options.request, options.output));
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
  if (options.as_json) {
    app::print_json(importers::import_json(outcomes.value()));
  } else {
    app::print("{}", importers::import_text(outcomes.value()));
  }
  return success;
}

struct TrafficOptions {
  std::string path;
  importers::TrafficRequest request;
  std::string output;
  bool as_json = false;
};

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
    app::print_json(importers::import_json(imported.value(), options.request, options.output));
  } else {
    app::print("{}", importers::import_text(imported.value(), options.request, options.output));
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

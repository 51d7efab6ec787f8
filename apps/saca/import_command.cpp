#include "apps/saca/options.h"
#include "saca/base/core/clock.h"
#include "saca/lab/importers/hundred_car.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/import_json.h"
#include "saca/lab/importers/import_text.h"
#include "saca/lab/importers/traffic_recording.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/progress.h"

namespace saca::app {
namespace {

struct HundredCarOptions {
  std::string path;
  importers::HundredCarRequest request;
  bool all = false;
  std::string output;
  bool as_json = false;
};

void import_one_event(const HundredCarOptions& options) {
  need_distinct({{"--output", options.output}}, {{"the events", options.path}});
  const auto imported = need(importers::import_hundred_car(options.path, options.request));
  const std::string text = scenario::write_scenario(imported.scenario);
  if (options.output.empty()) {
    app::print("{}", text);
    return;
  }
  write(options.output, text);
  app::print("{}", importers::import_text(imported.report, options.request, options.output));
}

/// Reads and rebuilds all events, with progress on the error stream.
std::vector<importers::HundredCarOutcome> all_events(const HundredCarOptions& options) {
  long_work::watch_for_interrupt();
  SteadyClock clock;
  constexpr int percent = 100;
  long_work::ProgressLine line("import 100car", percent, clock, progress_display());
  auto outcomes = importers::import_hundred_cars(
      options.path, options.request, [&](std::size_t done, std::size_t all) {
        line.show(static_cast<int>(percent * done / all), 0, " percent");
        return !long_work::interrupted();
      });
  if (!outcomes.has_value() && long_work::interrupted()) {
    throw Exit{was_interrupted};
  }
  return need(std::move(outcomes));
}

void import_all_events(const HundredCarOptions& options) {
  const fs::path folder = options.output;
  need_writable({folder.empty() ? fs::path() : folder / "x.toml"});
  const auto outcomes = all_events(options);
  if (!folder.empty()) {
    for (const importers::HundredCarOutcome& outcome : outcomes) {
      if (const importers::HundredCarImport* made = outcome.rebuilt()) {
        write(folder / (made->scenario.name + ".toml"), scenario::write_scenario(made->scenario));
      }
    }
  }
  tell(options.as_json, importers::import_json(outcomes), importers::import_text(outcomes));
}

void import_hundred_car(const HundredCarOptions& options) {
  options.all ? import_all_events(options) : import_one_event(options);
}

void add_hundred_car(CLI::App& import) {
  const auto [study, options] = add_command<HundredCarOptions>(
      import, "100car", "A rear-end conflict of the 100-Car study: ego, lead and follower",
      import_hundred_car);
  add_needed(study, "path", options.path,
             "Folder of the release (timeseries/ and meta/), or one time-series file");
  CLI::Option_group* const which = study.add_option_group("which");
  which->add_option("--event", options.request.event, "Event id");
  CLI::Option* const all =
      which->add_flag("--all", options.all, "Every event in or below the folder, with counts");
  which->require_option(1);
  add(study, "--before-s", options.request.before, "Kept before the conflict",
      within(1.0, 60.0, "s"));
  add(study, "--after-s", options.request.after, "Kept after the last evasive manoeuvre",
      within(0.0, 60.0, "s"));
  add(study, "--narrative", options.request.narrative, "The study's own words, quoted")
      ->excludes(all);
  add(study, "--output", options.output,
      "The scenario file; without it, to the terminal. With --all a folder; without it, only the "
      "counts are told");
  add_json(study, options.as_json, "The counts and every event's reason, for programs")->needs(all);
}

struct CommonRoadOptions {
  std::string path;
  importers::TrafficRequest request;
  std::string output;
  bool as_json = false;
};

void import_commonroad(const CommonRoadOptions& options) {
  need_distinct({{"--output", options.output}}, {{"the recording", options.path}});
  const auto imported = need(importers::import_commonroad(options.path, options.request));
  const std::string text = scenario::write_scenario(imported.scenario);
  if (const auto again = scenario::read_scenario(text, options.output); !again.has_value()) {
    refuse(again.error());
  }
  write(options.output, text);
  tell(options.as_json, importers::import_json(imported, options.request, options.output),
       importers::import_text(imported, options.request, options.output));
}

void add_commonroad(CLI::App& import) {
  const auto [traffic, options] = add_command<CommonRoadOptions>(
      import, "commonroad", "Recorded traffic of a CommonRoad file (XML 2020a) around the ego",
      import_commonroad);
  add_needed(traffic, "file", options.path, "The file");
  add(traffic, "--ego", options.request.ego,
      "Id of the obstacle whose place the ego takes; without it the ego begins at the planning "
      "problem's start");
  add(traffic, "--from-s", options.request.from,
      "Where in the file's time the scenario begins; without it where the ego does",
      within(0.0, 1e6));
  add(traffic, "--after-s", options.request.after,
      "How long the scenario goes on after the recording, everybody straight on",
      within(0.0, 60.0, "s"));
  add_needed(traffic, "--output", options.output, "The scenario file");
  add_json(traffic, options.as_json);
}

}  // namespace

void add_import(CLI::App& line) {
  CLI::App& import = add_group(line, "import", "Make a scenario of a recording");
  add_hundred_car(import);
  add_commonroad(import);
}

}  // namespace saca::app

#include "apps/saca/traffic_watching.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "apps/saca/settings.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/traffic_drives.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/traffic_recording.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/recordings/hundred_car_file.h"
#include "saca/lab/recordings/pack.h"
#include "saca/lab/suites/thresholds_text.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::ShadowRow;

constexpr std::size_t drives_per_thread = 8;  // between two looks at the signals

/// What the folders hold.
struct Findings {
  std::vector<DriveToWatch> drives;
  std::vector<std::string> notes;
  Fnv hash;  ///< of all files
};

Error stopped() {
  return {Error::Code::too_late, "stopped"};
}

std::optional<Error> hash_files(const std::vector<fs::path>& files, Fnv& hash) {
  for (const fs::path& file : files) {
    const auto text = read_file(file, many_bytes);
    if (!text.has_value()) {
      return text.error();
    }
    hash.add(file.filename().string());
    hash.add(text.value());
    if (long_work::interrupted()) {
      return stopped();
    }
  }
  return std::nullopt;
}

// --- CommonRoad

Result<RecordedEgo> recorded_ego(const eval::TrafficDrive& drive) {
  auto made = importers::import_commonroad(drive.file, {.ego = drive.obstacle, .from = drive.from});
  if (!made.has_value()) {
    return made.error();
  }
  importers::TrafficImport import = std::move(made).value();
  constexpr eval::Settling settling;
  const double recorded = std::get<scenario::Recording>(import.scenario.ego).back().time;
  const double until = std::min(drive.seconds, recorded - settling.before_end);
  if (until <= settling.after_start) {
    return Error{Error::Code::out_of_range,
                 "recorded for too short to be smoothed with samples on both sides"};
  }
  return RecordedEgo{std::move(import.scenario),
                     {.from = settling.after_start,
                      .until = until,
                      .lane_ahead = import.report.lane.ahead,
                      .settling = settling}};
}

std::optional<Error> find_commonroad(const std::vector<fs::path>& files, Findings& found) {
  const auto there = eval::drives_in(files, [] { return !long_work::interrupted(); });
  if (!there.has_value()) {
    return there.error();
  }
  for (const auto& [reason, count] : there.value().skipped) {
    found.notes.push_back(fmt::format("CommonRoad, passed over: {} x {}", count, reason));
  }
  for (const eval::TrafficDrive& drive : there.value().drives) {
    found.drives.push_back(
        {.source = drive.site,
         .name = fmt::format("{}, obstacle {} from {:.1f} s", drive.file.filename().string(),
                             drive.obstacle, drive.from),
         .command = fmt::format("saca import commonroad {} --ego {} --from-s {:.1f} --output "
                                "scenario.toml",
                                drive.file.string(), drive.obstacle, drive.from),
         .open = [drive] { return recorded_ego(drive); }});
  }
  if (there.value().num_others > 0) {
    found.notes.push_back(fmt::format("CommonRoad: {} tracks of other than cars are no egos",
                                      there.value().num_others));
  }
  return std::nullopt;
}

// --- 100-Car study

/// How long the lane may be kept before the conflict: the longest that the motion fits is taken
/// [s].
constexpr double times_before[] = {30.0, 20.0, 12.0};

/// From its first row on, until all is smoothed with rows on both sides (+-0.5 s, hundred_car.h)
/// and accelerations are differenced over half a second [s].
constexpr double settled_rows = 1.0;
constexpr eval::Settling radar_settling{.after_start = settled_rows, .before_end = 0.5};

double normal_seconds(const importers::HundredCarImport& made) {
  return recordings::hundred_car_step *
         static_cast<double>(made.report.conflict_row - made.report.first_row);
}

/// The longest that was made of each event.
std::optional<Error> find_hundred_cars(const fs::path& folder, Findings& found) {
  struct Best {
    const importers::HundredCarOutcome* outcome = nullptr;
    double before = 0.0;
  };
  std::vector<std::vector<importers::HundredCarOutcome>> all;
  for (const double before : times_before) {
    auto outcomes = importers::import_hundred_cars(
        folder, {.before = before},
        [](std::size_t, std::size_t) { return !long_work::interrupted(); });
    if (!outcomes.has_value()) {
      return outcomes.error();
    }
    all.push_back(std::move(outcomes).value());
  }
  std::map<std::int64_t, Best> best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (const importers::HundredCarOutcome& outcome : all[k]) {
      Best& one = best[outcome.event];
      const auto* made = outcome.rebuilt();
      const auto* before = one.outcome == nullptr ? nullptr : one.outcome->rebuilt();
      if (one.outcome == nullptr ||
          (made != nullptr &&
           (before == nullptr || normal_seconds(*made) > normal_seconds(*before)))) {
        one = {&outcome, times_before[k]};
      }
    }
  }
  std::map<importers::HundredCarReason, int> refused;
  for (const auto& [event, one] : best) {
    if (const auto* refusal = one.outcome->refusal()) {
      ++refused[refusal->reason];
      continue;
    }
    const importers::HundredCarImport made = *one.outcome->rebuilt();
    if (normal_seconds(made) <= settled_rows) {
      continue;  // it begins with the conflict
    }
    found.drives.push_back(
        {.source = "100car",
         .name = fmt::format("event {}", event),
         .command = fmt::format("saca import 100car {} --event {} --before-s {} --output "
                                "scenario.toml",
                                folder.string(), event, one.before),
         .open = [made]() -> Result<RecordedEgo> {
           return RecordedEgo{made.scenario,
                              {.from = settled_rows,
                               .until = normal_seconds(made),
                               .lane_ahead = {},
                               .settling = radar_settling}};
         }});
  }
  for (const auto& [reason, times] : refused) {
    found.notes.push_back(
        fmt::format("100-Car study: {} events not rebuilt: {}", times, meaning(reason)));
  }
  return std::nullopt;
}

// --- all of it

std::optional<Error> find_in(const std::string& folder, Findings& found) {
  if (!fs::is_directory(folder)) {
    return Error{Error::Code::unreadable, folder + ": want a folder, got none"};
  }
  const auto maps = recordings::files_in({folder}, ".xml");
  const auto texts = recordings::files_in({folder}, ".txt");
  if (!maps.has_value() || !texts.has_value()) {
    return maps.has_value() ? texts.error() : maps.error();
  }
  const bool study = std::any_of(texts.value().begin(), texts.value().end(), [](const fs::path& p) {
    return p.filename() == recordings::hundred_car_table;
  });
  if (maps.value().empty() && !study) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want CommonRoad files (*.xml) or the 100-Car study's release "
                             "(with {}), got neither",
                             folder, recordings::hundred_car_table)};
  }
  if (!maps.value().empty()) {
    if (auto problem = hash_files(maps.value(), found.hash)) {
      return problem;
    }
    if (auto problem = find_commonroad(maps.value(), found)) {
      return problem;
    }
  }
  if (study) {
    if (auto problem = hash_files(texts.value(), found.hash)) {
      return problem;
    }
    return find_hundred_cars(folder, found);
  }
  return std::nullopt;
}

/// Some of each source, as the seed has it.
std::vector<DriveToWatch> drawn_drives(std::vector<DriveToWatch> all, const TrafficWatch& options) {
  std::map<std::string, std::vector<DriveToWatch>> sources;
  for (DriveToWatch& drive : all) {
    sources[drive.source].push_back(std::move(drive));
  }
  std::vector<DriveToWatch> chosen;
  for (auto& [source, drives] : sources) {
    auto some = eval::some_of(std::move(drives), static_cast<std::size_t>(options.count),
                              options.seed, source);
    std::move(some.begin(), some.end(), std::back_inserter(chosen));
  }
  return chosen;
}

/// A row, whatever happens.
ShadowRow watched_row(const DriveToWatch& drive, const PlanesOfCar& planes,
                      const reflex::Thresholds& thresholds) {
  ShadowRow row{.source = drive.source, .drive = drive.name, .left_out = {}, .watched = {}};
  try {
    const auto ego = drive.open();
    if (!ego.has_value()) {
      row.left_out = ego.error().message;
      return row;
    }
    auto watched = eval::shadow_drive(ego.value().scenario,
                                      {.car = &planes.inputs.car,
                                       .intent = &planes.inputs.intent,
                                       .thresholds = thresholds,
                                       .saca = &planes.setup},
                                      ego.value().window);
    if (watched.has_value()) {
      row.watched = std::move(watched).value();
    } else {
      row.left_out = watched.error().message;
    }
  } catch (const std::exception& fault) {
    row.left_out = fault.what();
  }
  return row;
}

/// What the journal holds, if it is of these drives.
std::optional<Error> take_up(const Journal& journal, const std::string& path,
                             WatchedTraffic& traffic) {
  for (const std::string& line : journal.lines()) {
    auto row = eval::shadow_row_from(line);
    const std::size_t k = traffic.rows.size();
    const bool fits = row.has_value() && k < traffic.drives.size() &&
                      row.value().source == traffic.drives[k].source &&
                      row.value().drive == traffic.drives[k].name;
    if (!fits) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: {}", path, k + 2,
                               row.has_value() ? "another drive's" : row.error().message)};
    }
    traffic.rows.push_back(std::move(row).value());
  }
  return std::nullopt;
}

}  // namespace

Result<std::optional<WatchedTraffic>> watch_traffic(const TrafficWatch& options) {
  auto planes = open_planes(options.car, options.thresholds);
  if (!planes.has_value()) {
    return planes.error();
  }
  long_work::watch_for_interrupt();
  Findings found;
  for (const std::string& folder : options.folders) {
    if (auto problem = find_in(folder, found)) {
      return long_work::interrupted() ? Result<std::optional<WatchedTraffic>>(std::nullopt)
                                      : Result<std::optional<WatchedTraffic>>(*problem);
    }
  }
  WatchedTraffic traffic;
  traffic.planes = std::move(planes).value();
  traffic.found = found.drives.size();
  traffic.notes = found.notes;
  traffic.drives = drawn_drives(std::move(found.drives), options);
  if (traffic.drives.empty()) {
    return Error{Error::Code::malformed,
                 options.folders.front() + ": want a car's recording, got none"};
  }
  const std::string path = options.output + ".journal";
  if (auto problem = long_work::make_folder_of(path)) {
    return *problem;
  }
  const auto journal = Journal::open(
      path,
      fmt::format("saca {} suite traffic, {}, seed {}, count {}, {}, danger from {} and {} m/s^2 "
                  "on, data {:016x}",
                  SACA_VERSION, options.car, options.seed, options.count,
                  suites::thresholds_text(options.thresholds), eval::hard_braking,
                  eval::hard_steering, found.hash.value()));
  if (!journal.has_value()) {
    return journal.error();
  }
  if (auto problem = take_up(journal.value(), path, traffic)) {
    return *problem;
  }
  const std::size_t count = traffic.drives.size();
  const auto before = static_cast<int>(traffic.rows.size());
  SteadyClock clock;
  long_work::ProgressLine progress("suite traffic", static_cast<int>(count), clock,
                                   progress_display());
  while (traffic.rows.size() < count) {
    if (long_work::interrupted()) {
      return std::optional<WatchedTraffic>();
    }
    const std::size_t first = traffic.rows.size();
    std::vector<ShadowRow> next(
        std::min(drives_per_thread * static_cast<std::size_t>(options.threads), count - first));
    in_parallel(next.size(), options.threads, [&](std::size_t i) {
      next[i] = watched_row(traffic.drives[first + i], *traffic.planes, options.thresholds);
    });
    for (ShadowRow& row : next) {
      if (!journal.value().add(eval::line_of(row))) {
        return Error{Error::Code::unwritable, path + ": cannot be added to"};
      }
      traffic.rows.push_back(std::move(row));
    }
    progress.show(static_cast<int>(traffic.rows.size()), before, " drives");
  }
  return std::optional(std::move(traffic));
}

}  // namespace saca::app

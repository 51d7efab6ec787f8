#include "saca/lab/suites/recorded_drives.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/lab/eval/traffic_drives.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/importers/traffic_recording.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/recordings/hundred_car_file.h"
#include "saca/lab/recordings/pack.h"

namespace saca::suites {
namespace {

namespace fs = std::filesystem;

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

std::optional<Error> find_commonroad(const std::vector<fs::path>& files, FoundDrives& found) {
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

/// What was made of an event, and with how long before the conflict.
struct BestOutcome {
  importers::HundredCarOutcome outcome;
  double before = 0.0;  ///< [s]
};

/// The longest that was made of each event.
Result<std::map<std::int64_t, BestOutcome>> longest_outcomes(const fs::path& folder) {
  std::map<std::int64_t, BestOutcome> best;
  for (const double before : times_before) {
    auto outcomes = importers::import_hundred_cars(
        folder, {.before = before},
        [](std::size_t, std::size_t) { return !long_work::interrupted(); });
    if (!outcomes.has_value()) {
      return outcomes.error();
    }
    for (importers::HundredCarOutcome& outcome : std::vector(std::move(outcomes).value())) {
      const auto known = best.find(outcome.event);
      const auto* const made = outcome.rebuilt();
      const auto* const other = known == best.end() ? nullptr : known->second.outcome.rebuilt();
      if (known == best.end() ||
          (made != nullptr &&
           (other == nullptr || normal_seconds(*made) > normal_seconds(*other)))) {
        const std::int64_t event = outcome.event;
        best.insert_or_assign(event, BestOutcome{std::move(outcome), before});
      }
    }
  }
  return best;
}

std::optional<Error> find_hundred_cars(const fs::path& folder, FoundDrives& found) {
  const auto best = longest_outcomes(folder);
  if (!best.has_value()) {
    return best.error();
  }
  std::map<importers::HundredCarReason, int> refused;
  for (const auto& [event, one] : best.value()) {
    if (const auto* refusal = one.outcome.refusal()) {
      ++refused[refusal->reason];
      continue;
    }
    const importers::HundredCarImport made = *one.outcome.rebuilt();
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

std::optional<Error> find_in(const std::string& folder, FoundDrives& found) {
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

}  // namespace

Result<FoundDrives> find_drives(const std::vector<std::string>& folders) {
  FoundDrives found;
  for (const std::string& folder : folders) {
    if (auto problem = find_in(folder, found)) {
      return *std::move(problem);
    }
  }
  return found;
}

std::vector<DriveToWatch> drawn_drives(std::vector<DriveToWatch> all, std::size_t count,
                                       std::uint64_t seed) {
  std::map<std::string, std::vector<DriveToWatch>> sources;
  for (DriveToWatch& drive : all) {
    sources[drive.source].push_back(std::move(drive));
  }
  std::vector<DriveToWatch> chosen;
  for (auto& [source, drives] : sources) {
    auto some = eval::some_of(std::move(drives), count, seed, source);
    std::move(some.begin(), some.end(), std::back_inserter(chosen));
  }
  return chosen;
}

}  // namespace saca::suites

#include "saca/lab/eval/traffic_drives.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "saca/base/core/contract.h"
#include "saca/lab/importers/traffic_recording.h"
#include "saca/lab/intention_scoring/examples.h"
#include "saca/lab/recordings/pack.h"

namespace saca::eval {
namespace fs = std::filesystem;

Result<FoundDrives> drives_in(const std::vector<fs::path>& files,
                              const std::function<bool()>& goes_on) {
  std::map<std::string, fs::path> places;
  for (const fs::path& file : files) {
    const auto [place, is_new] = places.emplace(file.filename().string(), file);
    if (!is_new) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: want each file once, got another of this name: {}",
                               file.string(), place->second.string())};
    }
  }
  const auto packed =
      recordings::pack_commonroad(files, [&](std::size_t, std::size_t) { return goes_on(); });
  if (!packed.has_value()) {
    return packed.error();
  }
  if (!packed.value().refused.empty()) {
    return Error{Error::Code::malformed, packed.value().refused.front()};
  }
  FoundDrives found;
  found.skipped = packed.value().set.skipped;
  for (const recordings::Recording& recording : packed.value().set.recordings) {
    for (const recordings::RecordedVehicle& vehicle : recording.vehicles) {
      if (vehicle.type != "car") {
        ++found.num_others;
        continue;
      }
      found.drives.push_back(
          {.site = recording.site,
           .group = intention_scoring::group_of(recording, vehicle),
           .file = places.at(recording.name),
           .obstacle = vehicle.id,
           .from = vehicle.start,
           .seconds = recording.step * static_cast<double>(vehicle.samples.size() - 1)});
    }
  }
  return found;
}

Result<FoundDrives> traffic_drives(const std::vector<fs::path>& folders, std::size_t most,
                                   std::uint64_t seed, const std::function<bool()>& goes_on) {
  expects(most >= 1, "most >= 1");
  const auto files = recordings::files_in(folders, ".xml");
  if (!files.has_value()) {
    return files.error();
  }
  auto all = drives_in(files.value(), goes_on);
  if (!all.has_value()) {
    return all;
  }
  FoundDrives found = std::move(all).value();
  std::map<std::string, std::vector<TrafficDrive>> sites;
  for (TrafficDrive& drive : found.drives) {
    sites[drive.site].push_back(std::move(drive));
  }
  found.drives.clear();
  for (auto& [site, drives] : sites) {
    auto some = some_of(std::move(drives), most, seed, site);
    std::move(some.begin(), some.end(), std::back_inserter(found.drives));
  }
  if (found.drives.empty()) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want a car's recording, got none",
                             folders.empty() ? "" : folders.front().string())};
  }
  return found;
}

Result<PlayedDrive> played_drive(const TrafficDrive& drive) {
  auto made = importers::import_commonroad(drive.file, {.ego = drive.obstacle, .from = drive.from});
  if (!made.has_value()) {
    return made.error();
  }
  importers::TrafficImport import = std::move(made).value();
  constexpr Settling settling;
  const double recorded = std::get<scenario::Recording>(import.scenario.ego).back().time;
  const ForecastWindow window{.from = settling.after_start,
                              .until = std::min(drive.seconds, recorded),
                              .lane_behind = import.report.lane.behind,
                              .lane_ahead = import.report.lane.ahead,
                              .settling = settling};
  const double last_sample = import.scenario.duration;
  if (window.from > window.until ||
      window.from + forecast_times.back() + settling.before_end > last_sample) {
    return Error{
        Error::Code::out_of_range,
        fmt::format("{}, ego {}: want {:.1f} s, got {:.1f} s: recorded for too short to "
                    "hold a forecast against",
                    drive.file.string(), drive.obstacle,
                    window.from + forecast_times.back() + settling.before_end, last_sample)};
  }
  return PlayedDrive{std::move(import.scenario), window};
}

}  // namespace saca::eval

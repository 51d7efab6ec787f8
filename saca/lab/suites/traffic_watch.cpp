#include "saca/lab/suites/traffic_watch.h"

#include <fmt/core.h>

#include <exception>
#include <set>
#include <utility>

#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/lab/suites/thresholds_text.h"

namespace saca::suites {
namespace {

constexpr std::size_t drives_per_thread = 8;  // between two looks at the signals

/// A row, whatever happens.
ShadowRow watched_row(const DriveToWatch& drive, const WatchTools& tools,
                      const reflex::Thresholds& thresholds) {
  ShadowRow row{.source = drive.source, .drive = drive.name, .left_out = {}, .watched = {}};
  try {
    const auto ego = drive.open();
    if (!ego.has_value()) {
      row.left_out = ego.error().message;
      return row;
    }
    auto watched = shadow_drive(
        ego.value().scenario,
        {.car = tools.car, .intent = tools.intent, .thresholds = thresholds, .saca = tools.saca},
        ego.value().window);
    if (watched.has_value()) {
      row.watched = std::move(watched).value();
    } else {
      row.left_out = watched.error().message;
    }
  } catch (const std::exception& fault) {
    row.left_out = fault.what();
    row.failed = true;
  }
  return row;
}

/// A line of a journal, if it is of this drive.
Result<ShadowRow> row_of_drive(const std::string& line, const DriveToWatch& drive) {
  auto row = shadow_row_from(line);
  if (row.has_value() && (row.value().source != drive.source || row.value().drive != drive.name)) {
    return Error{Error::Code::malformed, "another drive's"};
  }
  return row;
}

}  // namespace

Result<std::optional<WatchedTraffic>> watch_traffic(const TrafficWatch& watch,
                                                    const WatchTools& tools,
                                                    const std::string& made_by,
                                                    long_work::ProgressDisplay display) {
  long_work::watch_for_interrupt();
  auto there = find_drives(watch.folders);
  if (!there.has_value()) {
    return long_work::interrupted() ? Result<std::optional<WatchedTraffic>>(std::nullopt)
                                    : Result<std::optional<WatchedTraffic>>(there.error());
  }
  FoundDrives found = std::move(there).value();
  WatchedTraffic traffic{
      .drives = {}, .rows = {}, .found = found.drives.size(), .notes = std::move(found.notes)};
  traffic.drives =
      drawn_drives(std::move(found.drives), static_cast<std::size_t>(watch.count), watch.seed);
  if (traffic.drives.empty()) {
    return Error{Error::Code::malformed,
                 watch.folders.front() + ": want a car's recording, got none"};
  }
  auto rows = long_work::rows_of<ShadowRow>(
      {.journal = watch.output + ".journal",
       .title = fmt::format(
           "saca {} suite traffic, {}, seed {}, count {}, {}, danger from {} and {} m/s^2 on, "
           "data {:016x}, intentions {:016x}",
           made_by, watch.car, watch.seed, watch.count, thresholds_text(watch.thresholds),
           eval::hard_braking, eval::hard_steering, found.hash.value(),
           intent::digest(*tools.intent)),
       .progress = "suite traffic",
       .unit = "drives",
       .count = traffic.drives.size(),
       .display = display,
       .threads = watch.threads,
       .at_once = drives_per_thread * static_cast<std::size_t>(watch.threads),
       .row =
           [&](std::size_t k) { return watched_row(traffic.drives[k], tools, watch.thresholds); },
       .line_of = [](const ShadowRow& row) { return suites::line_of(row); },
       .row_from =
           [&, k = std::size_t{0}](const std::string& line) mutable {
             return row_of_drive(line, traffic.drives[k++]);
           }});
  if (!rows.has_value()) {
    return rows.error();
  }
  if (!rows.value()) {
    return std::optional<WatchedTraffic>();
  }
  traffic.rows = *std::move(rows).value();
  return std::optional(std::move(traffic));
}

std::string command_of(const TrafficWatch& watch) {
  std::string folders;
  for (const std::string& folder : watch.folders) {
    folders += " " + folder;
  }
  return fmt::format("saca suite traffic --data{} --count {} --seed {} --car {}{}", folders,
                     watch.count, watch.seed, watch.car, thresholds_arguments(watch.thresholds));
}

std::vector<std::string> sources_of(const WatchedTraffic& traffic) {
  std::set<std::string> sources;
  for (const DriveToWatch& drive : traffic.drives) {
    sources.insert(drive.source);
  }
  return {sources.begin(), sources.end()};
}

}  // namespace saca::suites

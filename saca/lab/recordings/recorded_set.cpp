#include "saca/lab/recordings/recorded_set.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <set>

namespace saca::recordings {
namespace {

bool is_known(double value) {
  return std::isfinite(value);
}
bool known_or_nan(double value) {
  return is_known(value) || std::isnan(value);
}
bool is_size(double value) {
  return std::isnan(value) || (is_known(value) && value > 0.0);
}
bool is_share(double value) {
  return std::isnan(value) || (value >= 0.0 && value <= 1.0);
}
bool is_one_line(const std::string& text) {
  return !text.empty() && text.find_first_of("\r\n") == std::string::npos &&
         text.find('\0') == std::string::npos;
}

/// What is wrong with a sample; nullptr: nothing.
const char* wrong_sample(const Sample& sample) {
  const Pose& X_WA = sample.X_WA;
  const int known = int{is_known(X_WA.p.x)} + int{is_known(X_WA.p.y)} + int{is_known(X_WA.yaw)};
  const int nans =
      int{std::isnan(X_WA.p.x)} + int{std::isnan(X_WA.p.y)} + int{std::isnan(X_WA.yaw)};
  if (known != 3 && nans != 3) {
    return "pose: want finite numbers or NaN for all three";
  }
  if (!is_known(sample.speed)) {
    return "speed: want a finite number";
  }
  for (const double value : {sample.offset, sample.heading, sample.curvature, sample.steering,
                             sample.measured_acceleration, sample.measured_yaw_rate}) {
    if (!known_or_nan(value)) {
      return "offset, heading, curvature, steering, accelerometer or yaw rate: want a finite "
             "number or NaN";
    }
  }
  if (!is_size(sample.lane_width)) {
    return "lane width: want a number > 0 or NaN";
  }
  if (sample.lane_step != 0 && (std::abs(sample.lane_step) > 1 || !is_known(sample.offset))) {
    return "lane step: want -1, 0 or 1, and an offset with it";
  }
  if (!(known_or_nan(sample.gap) || sample.gap > 0.0)) {
    return "gap: want a finite number, +inf or NaN";
  }
  if (!known_or_nan(sample.lead_speed) || (is_known(sample.lead_speed) && !is_known(sample.gap))) {
    return "lead speed: want a finite number beside a finite gap, or NaN";
  }
  if (!is_share(sample.brake_pedal) || !is_share(sample.throttle)) {
    return "pedals: want 0 to 1 or NaN";
  }
  return nullptr;
}

std::optional<std::string> wrong_vehicle(const RecordedVehicle& vehicle) {
  if (vehicle.type.find_first_of("\r\n") != std::string::npos ||
      vehicle.type.find('\0') != std::string::npos) {
    return "type: want one line";
  }
  if (!is_size(vehicle.length) || !is_size(vehicle.width)) {
    return "length and width: want numbers > 0 or NaN";
  }
  if (!is_known(vehicle.start)) {
    return "start: want a finite number";
  }
  constexpr std::int64_t most = std::int64_t{1} << 53;  // exact as a double
  if (vehicle.id > most || vehicle.id < -most) {
    return "id: want at most 2^53";
  }
  if (vehicle.samples.empty()) {
    return "want at least one sample";
  }
  for (std::size_t k = 0; k < vehicle.samples.size(); ++k) {
    if (const char* const wrong = wrong_sample(vehicle.samples[k])) {
      return fmt::format("sample {}: {}", k, wrong);
    }
  }
  return std::nullopt;
}

std::optional<std::string> wrong_recording(const Recording& recording) {
  if (!is_one_line(recording.name) || !is_one_line(recording.site) ||
      !is_one_line(recording.group)) {
    return "name, site and group: want one line each";
  }
  if (!(recording.step > 0.0 && is_known(recording.step))) {
    return "step: want a number > 0";
  }
  if (recording.vehicles.empty()) {
    return "want at least one vehicle";
  }
  for (const RecordedVehicle& vehicle : recording.vehicles) {
    if (const auto wrong = wrong_vehicle(vehicle)) {
      return fmt::format("vehicle {}: {}", vehicle.id, *wrong);
    }
  }
  return std::nullopt;
}

struct Counting {
  SetCounts counts;
  std::set<std::string> groups;

  void add(const Recording& recording) {
    ++counts.recordings;
    groups.insert(recording.group);
    counts.groups = groups.size();
    for (const RecordedVehicle& vehicle : recording.vehicles) {
      add(vehicle, recording.step);
    }
  }
  void add(const RecordedVehicle& vehicle, double step) {
    ++counts.vehicles;
    counts.samples += vehicle.samples.size();
    counts.hours += static_cast<double>(vehicle.samples.size()) * step / 3600.0;
    for (const Sample& sample : vehicle.samples) {
      counts.steps_left += sample.lane_step > 0 ? 1U : 0U;
      counts.steps_right += sample.lane_step < 0 ? 1U : 0U;
      counts.in_lane += std::isnan(sample.offset) ? 0U : 1U;
      counts.with_lead += std::isfinite(sample.gap) ? 1U : 0U;
    }
  }
};

}  // namespace

std::optional<std::string> broken_rule(const RecordedSet& set) {
  if (set.recordings.empty()) {
    return "want at least one recording";
  }
  for (const Recording& recording : set.recordings) {
    if (const auto wrong = wrong_recording(recording)) {
      return fmt::format("recording {}: {}", recording.name, *wrong);
    }
  }
  for (const auto& [reason, count] : set.skipped) {
    if (!is_one_line(reason) || count == 0) {
      return "what was skipped: want a reason in one line and a count > 0";
    }
  }
  return std::nullopt;
}

SetCounts counts_of(const RecordedSet& set) {
  Counting counting;
  for (const Recording& recording : set.recordings) {
    counting.add(recording);
  }
  return counting.counts;
}

std::map<std::string, SetCounts> counts_by_site(const RecordedSet& set) {
  std::map<std::string, Counting> sites;
  for (const Recording& recording : set.recordings) {
    sites[recording.site].add(recording);
  }
  std::map<std::string, SetCounts> counts;
  for (const auto& [site, counting] : sites) {
    counts[site] = counting.counts;
  }
  return counts;
}

}  // namespace saca::recordings

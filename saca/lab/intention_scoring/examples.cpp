#include "saca/lab/intention_scoring/examples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"
#include "saca/base/core/vec2.h"
#include "saca/lab/recordings/rts_smoother.h"

namespace saca::intention_scoring {
namespace {

using intent::Observation;
using recordings::RecordedVehicle;
using recordings::Sample;

// Recordings number vehicles as they come: near ids drove at the same time. Recordings that share a
// vehicle make chains of many minutes; blocks of ids divide them without dividing any vehicle.
constexpr std::int64_t ids_per_group = 100;
constexpr std::size_t tracked = 5;  // steps over which a tracker forms differences

/// Way to the left across the lanes since the lane was last found [m]; NaN: on no lane.
std::vector<double> ways_aside(const RecordedVehicle& vehicle) {
  std::vector<double> ways;
  const Sample* last = nullptr;
  for (const Sample& now : vehicle.samples) {
    double way = now.offset;
    if (last != nullptr && !std::isnan(last->offset) && !std::isnan(now.offset)) {
      const double width = 0.5 * (last->lane_width + now.lane_width);
      way = ways.back() + now.offset - last->offset + now.lane_step * width;
    }
    ways.push_back(way);
    last = &now;
  }
  return ways;
}

/// Slope of the line through what was known during the last 0.5 s, or less: least squares.
double slope_behind(const std::vector<double>& values, std::size_t now, double step) {
  double n = 0.0;
  double sum_t = 0.0;
  double sum_x = 0.0;
  double sum_tt = 0.0;
  double sum_tx = 0.0;
  for (std::size_t back = 0; back <= std::min(now, tracked); ++back) {
    const double x = values[now - back];
    if (std::isnan(x)) {
      break;
    }
    const double t = -static_cast<double>(back) * step;
    n += 1.0;
    sum_t += t;
    sum_x += x;
    sum_tt += t * t;
    sum_tx += t * x;
  }
  return n < 2.0 ? 0.0 : (n * sum_tx - sum_t * sum_x) / (n * sum_tt - sum_t * sum_t);
}

/// Speeds as a tracker would follow them. A car's own speedometer stands for up to a second; where
/// there is an accelerometer it carries the speed on, and new values pull it back within 1 s.
std::vector<double> tracked_speeds(const RecordedVehicle& vehicle, double step) {
  constexpr double pull = 1.0;  // [1/s]
  std::vector<double> speeds;
  for (const Sample& now : vehicle.samples) {
    if (speeds.empty() || std::isnan(now.measured_acceleration)) {
      speeds.push_back(now.speed);
      continue;
    }
    const double carried = std::max(0.0, speeds.back() + now.measured_acceleration * step);
    speeds.push_back(now.speed == 0.0 ? 0.0 : carried + pull * step * (now.speed - carried));
  }
  return speeds;
}

/// Turning rate over the last 0.5 s, or less [rad/s].
double turning(const RecordedVehicle& vehicle, std::size_t now, double step) {
  const Sample& sample = vehicle.samples[now];
  if (!std::isnan(sample.measured_yaw_rate)) {
    return sample.measured_yaw_rate;
  }
  const std::size_t back = std::min(now, tracked);
  const double before = vehicle.samples[now - back].X_WA.yaw;
  if (back == 0 || std::isnan(before) || std::isnan(sample.X_WA.yaw)) {
    return 0.0;
  }
  return wrap_angle(sample.X_WA.yaw - before) / (static_cast<double>(back) * step);
}

/// Each stretch without gaps smoothed for itself; NaN elsewhere, and in stretches of less than
/// three.
recordings::AxisMotion smooth_stretches(const std::vector<double>& values, double step) {
  const std::vector<double> nothing(values.size(), std::nan(""));
  recordings::AxisMotion whole{nothing, nothing, nothing};
  for (std::size_t first = 0; first < values.size();) {
    std::size_t last = first;
    while (last < values.size() && !std::isnan(values[last])) {
      ++last;
    }
    if (last >= first + 3) {
      const auto begin = static_cast<std::ptrdiff_t>(first);
      const recordings::AxisMotion motion = recordings::smooth_axis(
          {values.begin() + begin, values.begin() + static_cast<std::ptrdiff_t>(last)}, {}, step);
      std::copy(motion.position.begin(), motion.position.end(), whole.position.begin() + begin);
      std::copy(motion.velocity.begin(), motion.velocity.end(), whole.velocity.begin() + begin);
      std::copy(motion.acceleration.begin(), motion.acceleration.end(),
                whole.acceleration.begin() + begin);
    }
    first = std::max(last, first + 1);
  }
  return whole;
}

/// Way along the heading since the first sample [m]: of positions where they are recorded, else of
/// speeds.
std::vector<double> ways_along(const RecordedVehicle& vehicle, double step) {
  std::vector<double> ways{0.0};
  for (std::size_t i = 1; i < vehicle.samples.size(); ++i) {
    const Sample& last = vehicle.samples[i - 1];
    const Sample& now = vehicle.samples[i];
    double made = 0.5 * (last.speed + now.speed) * step;
    if (!std::isnan(last.X_WA.yaw) && !std::isnan(now.X_WA.yaw)) {
      const double course = last.X_WA.yaw + 0.5 * wrap_angle(now.X_WA.yaw - last.X_WA.yaw);
      made = rotated(now.X_WA.p - last.X_WA.p, -course).x;
    }
    ways.push_back(ways.back() + made);
  }
  return ways;
}

}  // namespace

std::vector<Observation> observations_of(const RecordedVehicle& vehicle, double step) {
  const std::vector<double> ways = ways_aside(vehicle);
  const std::vector<double> speeds = tracked_speeds(vehicle, step);
  std::vector<Observation> seen;
  for (std::size_t i = 0; i < vehicle.samples.size(); ++i) {
    const Sample& now = vehicle.samples[i];
    Observation one{.speed = std::abs(speeds[i]),
                    .acceleration = slope_behind(speeds, i, step),
                    .yaw_rate = turning(vehicle, i, step),
                    .gap = now.gap,
                    .gap_speed = now.lead_speed - speeds[i],
                    .steering = now.steering,
                    .throttle = now.throttle,
                    .brake = now.brake_pedal};
    if (!std::isnan(now.offset)) {
      one.offset = now.offset;
      one.lane_width = now.lane_width;
      one.lateral_speed = slope_behind(ways, i, step);
      one.heading = std::isnan(now.heading) ? 0.0 : now.heading;
    }
    seen.push_back(one);
  }
  return seen;
}

TrueMotion true_motion(const RecordedVehicle& vehicle, double step) {
  TrueMotion motion;
  motion.acceleration = smooth_stretches(ways_along(vehicle, step), step).acceleration;
  std::vector<double> measured;
  for (const Sample& sample : vehicle.samples) {
    measured.push_back(sample.measured_acceleration);
  }
  const std::vector<double> smooth = smooth_stretches(measured, step).position;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    if (!std::isnan(smooth[i])) {
      motion.acceleration[i] = smooth[i];
    }
  }
  recordings::AxisMotion aside = smooth_stretches(ways_aside(vehicle), step);
  motion.lateral = std::move(aside.position);
  motion.lateral_speed = std::move(aside.velocity);
  for (const Sample& sample : vehicle.samples) {
    if (!std::isnan(sample.lane_width)) {
      motion.lane_width = sample.lane_width;  // it changes little along a track
    }
  }
  return motion;
}

std::string group_of(const recordings::Recording& recording, const RecordedVehicle& vehicle) {
  return fmt::format("{}/{}", recording.group, vehicle.id / ids_per_group);
}

std::vector<Sequence> examples_of(const recordings::RecordedSet& set) {
  std::vector<Sequence> sequences;
  for (const recordings::Recording& recording : set.recordings) {
    expects(std::abs(recording.step - frame_step) < 1e-9, "recordings at frame_step");
    for (const RecordedVehicle& vehicle : recording.vehicles) {
      if (vehicle.samples.size() < fewest_frames) {
        continue;
      }
      Labels labels = labels_of(true_motion(vehicle, recording.step));
      Sequence sequence{
          .name = fmt::format("{}/{}@{:.1f}", recording.name, vehicle.id, vehicle.start),
          .site = recording.site,
          .group = group_of(recording, vehicle),
          .observations = observations_of(vehicle, recording.step),
          .labels = std::move(labels.classes),
          .scored = std::move(labels.scored),
          .braking_times = std::move(labels.braking_times)};
      for (std::size_t i = 0; i < vehicle.samples.size(); ++i) {
        if (vehicle.samples[i].lane_step != 0) {
          sequence.crossing_times.push_back(static_cast<double>(i) * frame_step);
        }
      }
      sequences.push_back(std::move(sequence));
    }
  }
  return sequences;
}

}  // namespace saca::intention_scoring

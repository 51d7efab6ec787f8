#include "saca/lab/recordings/hundred_car_set.h"

#include <cmath>
#include <optional>
#include <utility>

#include "saca/lab/recordings/lane_map.h"
#include "saca/lab/recordings/recording_of_map.h"

namespace saca::recordings {
namespace {

constexpr std::size_t longest_blink = 5;  // rows without marks across a lane step
constexpr double jump_slack = 0.8;        // of a jump against the lane's width [m]

void set_lane(const HundredCarRow& row, Sample& sample) {
  const double width = row.left_mark - row.right_mark;
  const double offset = -0.5 * (row.left_mark + row.right_mark);
  if (row.mark_trust > least_mark_trust && width >= narrowest_lane && width <= widest_lane &&
      std::abs(offset) <= 0.5 * width + lane_hold) {
    sample.offset = offset;
    sample.lane_width = width;
  }
}

/// Marks the sample from which on the tracker measures against the next lane.
void set_lane_steps(std::vector<Sample>& samples) {
  std::optional<std::size_t> last;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (std::isnan(samples[k].offset)) {
      continue;
    }
    if (last && k - *last <= longest_blink) {
      const double before = samples[*last].offset;
      const double jump = samples[k].offset - before;
      const bool other_side = before * samples[k].offset < 0.0;
      if (other_side && std::abs(std::abs(jump) - samples[k].lane_width) <= jump_slack) {
        samples[k].lane_step = jump < 0.0 ? 1 : -1;  // beyond the left mark, one is on the right
      }
    }
    last = k;
  }
}

std::vector<Sample> samples_of_rows(const std::vector<HundredCarRow>& rows) {
  std::vector<Sample> samples;
  for (const HundredCarRow& row : rows) {
    Sample sample;
    sample.speed = row.speed;
    sample.measured_yaw_rate = row.yaw_rate;
    sample.measured_acceleration = row.acceleration;
    sample.brake_pedal = !row.brake_known ? not_known : row.brake ? 1.0 : 0.0;
    set_lane(row, sample);
    samples.push_back(sample);
  }
  set_lane_steps(samples);
  return samples;
}

}  // namespace

Recording recording_of_event(const std::vector<HundredCarRow>& rows, const HundredCarEvent& event,
                             std::string name, std::map<std::string, std::size_t>& skipped) {
  Recording recording{
      std::move(name), "100car", "100car-" + std::to_string(event.vehicle), hundred_car_step, {}};
  const std::vector<Sample> samples = samples_of_rows(rows);
  for (std::size_t from = 0; from < samples.size();) {
    if (std::isnan(samples[from].speed)) {
      ++from;
      continue;
    }
    std::size_t to = from + 1;
    while (to < samples.size() && !std::isnan(samples[to].speed)) {
      ++to;
    }
    if (to - from < fewest_packed) {
      ++skipped["vehicle: fewer than 10 samples on end"];
    } else {
      RecordedVehicle vehicle{.id = event.vehicle,
                              .start = hundred_car_step * static_cast<double>(from)};
      const auto first = samples.begin() + static_cast<std::ptrdiff_t>(from);
      vehicle.samples.assign(first, samples.begin() + static_cast<std::ptrdiff_t>(to));
      vehicle.samples.front().lane_step = 0;  // nobody saw the sample before
      recording.vehicles.push_back(std::move(vehicle));
    }
    from = to;
  }
  return recording;
}

}  // namespace saca::recordings

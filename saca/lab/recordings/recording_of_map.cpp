#include "saca/lab/recordings/recording_of_map.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/lab/recordings/lane_map.h"

namespace saca::recordings {
namespace {

constexpr double longest_body = 25.0;     // [m]: how far beyond the reach a lead's centre may be
constexpr double remembered_place = 1.0;  // [s] on no lane

/// One state of an obstacle in the lanes.
struct LaneState {
  Pose X_WA;
  std::optional<LanePlace> place;
  int lane_step = 0;
  std::vector<LanePlace> held_by;  ///< all lanelets that hold it
};

/// An obstacle's states in the lanes, and who was there at the same time.
struct ObstacleHistory {
  const Obstacle* obstacle = nullptr;
  std::vector<LaneState> states;
};

ObstacleHistory followed_in(const LaneMap& lanes, const Obstacle& obstacle, double step) {
  ObstacleHistory made{&obstacle, {}};
  std::optional<LanePlace> last;
  std::int64_t seen_last = 0;
  for (const ObstacleState& state : obstacle.states) {
    if (static_cast<double>(state.step - seen_last) * step > remembered_place) {
      last.reset();
    }
    LaneState sighted{state.X_WO * obstacle.X_OA, {}, 0, {}};
    const LaneSighting now = lanes.follow(last, sighted.X_WA);
    sighted.place = now.place;
    sighted.lane_step = now.lane_step;
    sighted.held_by = lanes.places(sighted.X_WA);
    if (now.place) {
      last = now.place;
      seen_last = state.step;
    }
    made.states.push_back(std::move(sighted));
  }
  return made;
}

/// Who is there at a step: index of the obstacle, and of its state.
using Present = std::vector<std::pair<std::size_t, std::size_t>>;

std::map<std::int64_t, Present> present_at_steps(const std::vector<ObstacleHistory>& all) {
  std::map<std::int64_t, Present> steps;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<ObstacleState>& states = all[i].obstacle->states;
    for (std::size_t k = 0; k < states.size(); ++k) {
      steps[states[k].step].emplace_back(i, k);
    }
  }
  return steps;
}

/// Way from the lane's beginning to a body's centre, if it is on that lane ahead.
std::optional<double> way_to(const LaneState& other, const LaneMap::Way& way) {
  std::optional<double> nearest;
  for (const LanePlace& held : other.held_by) {
    for (const LaneMap::Ahead& ahead : way.lanelets) {
      const double s = ahead.way + held.along;
      if (ahead.lanelet == held.lanelet && s > 0.0 && (!nearest || s < *nearest)) {
        nearest = s;
      }
    }
  }
  return nearest;
}

void set_lead(const LaneMap& lanes, const std::vector<ObstacleHistory>& all, const Present& present,
              std::size_t self, const LanePlace& place, Sample& sample) {
  const LaneMap::Way way = lanes.way_ahead(place, lead_reach + longest_body);
  const double half = 0.5 * all[self].obstacle->footprint.length;
  sample.gap = way.end >= lead_reach + half ? std::numeric_limits<double>::infinity() : not_known;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [i, k] : present) {
    const std::optional<double> s = i == self ? std::nullopt : way_to(all[i].states[k], way);
    if (!s || *s >= least) {
      continue;
    }
    const double gap = *s - half - 0.5 * all[i].obstacle->footprint.length;
    if (gap <= lead_reach) {
      least = *s;
      sample.gap = gap;
      sample.lead_speed = all[i].obstacle->states[k].speed;
    }
  }
}

Sample sample_of(const LaneMap& lanes, const LaneState& sighted, double speed) {
  Sample sample;
  sample.X_WA = sighted.X_WA;
  sample.speed = speed;
  if (const std::optional<LanePlace>& place = sighted.place) {
    const LaneMap::Line& line = lanes.lanelets()[place->lanelet];
    sample.offset = place->offset;
    sample.heading = place->heading;
    sample.lane_width = place->width;
    sample.curvature = place->curvature;
    sample.lane_step = sighted.lane_step;
    sample.left_lane = line.left.has_value();
    sample.right_lane = line.right.has_value();
  }
  return sample;
}

/// Cuts the states where steps are missing.
void add_tracks(std::vector<Sample> samples, const Obstacle& obstacle, double step,
                Recording& recording, std::map<std::string, std::size_t>& skipped) {
  const std::vector<ObstacleState>& states = obstacle.states;
  for (std::size_t from = 0; from < states.size();) {
    std::size_t to = from + 1;
    while (to < states.size() && states[to].step == states[to - 1].step + 1) {
      ++to;
    }
    if (to - from < fewest_packed) {
      ++skipped["vehicle: fewer than 10 samples on end"];
    } else {
      const auto first = samples.begin() + static_cast<std::ptrdiff_t>(from);
      const auto last = samples.begin() + static_cast<std::ptrdiff_t>(to);
      RecordedVehicle vehicle{.id = obstacle.id,
                              .type = obstacle.type,
                              .length = obstacle.footprint.length,
                              .width = obstacle.footprint.width,
                              .start = static_cast<double>(states[from].step) * step,
                              .samples = {first, last}};
      vehicle.samples.front().lane_step = 0;  // nobody saw the sample before
      recording.vehicles.push_back(std::move(vehicle));
    }
    from = to;
  }
}

std::string site_of(std::string_view benchmark) {
  const std::size_t from = benchmark.find('_') + 1;  // 0 where there is none
  std::string site(benchmark.substr(from, benchmark.find('-', from) - from));
  std::transform(site.begin(), site.end(), site.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  if (site.empty() || site.find_first_of("\r\n") != std::string::npos) {
    return "unknown";
  }
  // The database's own short forms.
  return site == "lanker" ? "lankershim" : site == "peach" ? "peachtree" : site;
}

}  // namespace

Recording recording_of_map(const CommonRoad& file, std::string name,
                           std::map<std::string, std::size_t>& skipped) {
  const LaneMap lanes(file);
  std::vector<ObstacleHistory> all;
  for (const Obstacle& obstacle : file.obstacles) {
    if (obstacle.dynamic) {
      all.push_back(followed_in(lanes, obstacle, file.time_step));
    } else {
      ++skipped["static obstacle"];
    }
  }
  const std::map<std::int64_t, Present> present = present_at_steps(all);
  Recording recording{std::move(name), site_of(file.benchmark), "", file.time_step, {}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Obstacle& obstacle = *all[i].obstacle;
    std::vector<Sample> samples;
    for (std::size_t k = 0; k < all[i].states.size(); ++k) {
      const LaneState& sighted = all[i].states[k];
      samples.push_back(sample_of(lanes, sighted, obstacle.states[k].speed));
      if (sighted.place) {
        set_lead(lanes, all, present.at(obstacle.states[k].step), i, *sighted.place,
                 samples.back());
      }
    }
    add_tracks(std::move(samples), obstacle, file.time_step, recording, skipped);
  }
  return recording;
}

}  // namespace saca::recordings

#include "saca/sim/hundred_car.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "saca/core/contract.h"
#include "saca/core/file.h"
#include "saca/sim/ego_path.h"
#include "saca/sim/hundred_car_words.h"
#include "saca/sim/rounding.h"
#include "saca/traffic/radar_track.h"
#include "saca/traffic/series.h"

namespace saca::sim {
namespace {

namespace fs = std::filesystem;

constexpr double dt = traffic::hundred_car_step;
constexpr std::size_t half_second = 5;   // rows
constexpr std::size_t longest_hold = 8;  // rows between two values of the slowest speed sensor
constexpr std::size_t longest_speed_gap = 15;  // rows
constexpr std::size_t fewest_follower_rows = 20;
constexpr std::size_t fewest_lead_rows = 20;
constexpr double after_the_end = 8.0;  // of the recording, for what SACA does instead [s]

/// Rows of the scenario, as [first, last] indices.
struct Window {
  std::size_t first;
  std::size_t last;
  [[nodiscard]] std::size_t size() const { return last - first + 1; }
};

/// Index of the row with a sync, clamped to the rows there are.
std::size_t row_at(const std::vector<traffic::HundredCarRow>& rows, std::int64_t sync) {
  const std::int64_t last = static_cast<std::int64_t>(rows.size()) - 1;
  return static_cast<std::size_t>(std::clamp(sync - rows.front().sync, std::int64_t{0}, last));
}

std::size_t steps(double seconds) {
  return static_cast<std::size_t>(std::lround(seconds / dt));
}

/// The ego's measured motion in the window, treated.
struct EgoMotion {
  std::vector<double> speed;
  std::vector<double> yaw_rate;  ///< without the bias
  std::size_t num_speed_missing = 0;
  EgoPath path;
};

/// Longest stretch of NaN.
std::size_t longest_missing(const std::vector<double>& values) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (const double value : values) {
    run = std::isnan(value) ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

Result<EgoMotion> ego_motion(const std::vector<traffic::HundredCarRow>& rows, const Window& window,
                             std::size_t conflict_row, bool curved) {
  std::vector<double> speed;
  std::vector<double> yaw_rate;
  for (std::size_t row = window.first; row <= window.last; ++row) {
    speed.push_back(rows[row].speed);
    yaw_rate.push_back(rows[row].yaw_rate);
  }
  if (longest_missing(speed) > longest_speed_gap || longest_missing(yaw_rate) > longest_speed_gap) {
    return Error{Error::Code::malformed,
                 "want speed and yaw rate with gaps of at most 1.5 s, got longer ones in rows " +
                     std::to_string(window.first + 1) + " to " + std::to_string(window.last + 1)};
  }
  EgoMotion ego;
  ego.num_speed_missing = static_cast<std::size_t>(
      std::count_if(speed.begin(), speed.end(), [](double v) { return std::isnan(v); }));
  const std::vector<double> updates =
      traffic::filled(traffic::without_holds(traffic::filled(speed).values, longest_hold)).values;
  ego.speed = traffic::line_fit(updates, dt, half_second).values;
  for (double& v : ego.speed) {
    v = std::max(0.0, v);
  }
  constexpr double impossible =
      0.35;  // from the median of its neighbours [rad/s]: a jolt, not a turn
  (void)traffic::remove_outliers(yaw_rate, std::vector<double>(yaw_rate.size(), 0.0), dt, 2,
                                 impossible);
  ego.yaw_rate = traffic::filled(yaw_rate).values;
  const std::size_t keeping = conflict_row - window.first + 1;
  ego.path = ego_path(ego.speed, ego.yaw_rate, dt, keeping, curved);
  for (double& rate : ego.yaw_rate) {
    rate -= ego.path.gyro_bias;
  }
  return ego;
}

/// The ego's lane with what the videos say of the road.
world::Road road_of(const traffic::HundredCarEvent& event, double curvature) {
  world::Road road;
  road.curvature = rounded(curvature, 1e6);
  road.lane_width = assumed_lane_width;
  const LanesAround lanes = lanes_around(event);
  const double half = 0.5 * assumed_lane_width;
  road.left_edge = half + lanes.left * assumed_lane_width;
  road.right_edge = -half;
  road.left_beyond = lanes.divided ? world::Beyond::barrier : world::Beyond::unmarked;
  road.oncoming_left = lanes.oncoming_left;
  return road;
}

Recording ego_recording(const EgoMotion& ego, const world::Road& road) {
  Recording recording;
  for (std::size_t k = 0; k < ego.speed.size(); ++k) {
    const Pose X_WB = from_lane(road, ego.path.poses[k]);
    recording.push_back({rounded(static_cast<double>(k) * dt, 10.0), rounded_pose(X_WB),
                         rounded_mm(ego.speed[k]), rounded_angle(ego.yaw_rate[k])});
  }
  return recording;
}

/// A radar's track as the motion of a body's centre, and how it was treated.
struct Rebuilt {
  Recording recording;
  TreatedTrack treated;
};

/// The part of a track that lies in the window.
Window common(const traffic::RadarTrack& track, const Window& window) {
  return {std::max(track.first_row, window.first), std::min(track.last_row, window.last)};
}

/// What was measured of a part of a track.
TreatedTrack treated(const traffic::RadarTrack& track, const Window& part) {
  TreatedTrack told;
  told.first_row = static_cast<std::int64_t>(part.first) + 1;
  told.last_row = static_cast<std::int64_t>(part.last) + 1;
  bool in_gap = false;
  for (std::size_t row = part.first; row <= part.last; ++row) {
    const std::size_t i = row - track.first_row;
    const bool seen = track.sightings[i] == traffic::Sighting::kept;
    told.num_seen += seen ? 1U : 0U;
    told.num_filled += seen ? 0U : 1U;
    told.num_outliers += track.sightings[i] == traffic::Sighting::outlier ? 1U : 0U;
    told.num_gaps += !seen && !in_gap ? 1U : 0U;
    in_gap = !seen;
    if (seen && (told.ids.empty() || told.ids.back() != track.ids[i])) {
      told.ids.push_back(track.ids[i]);
    }
  }
  told.rate_disagreement =
      traffic::rate_disagreement(track, part.first - track.first_row, part.last - track.first_row);
  return told;
}

/// @param side    +1: the radar looks forward; -1: backward
/// @param length  of the body that is seen [m]
Rebuilt rebuilt(const traffic::RadarTrack& track, const Window& window, const EgoMotion& ego,
                const world::Road& road, double side, double length) {
  const Window part = common(track, window);
  constexpr double slope_weight = 1.0;  // [s^2]: noise of 0.3 m and 0.3 m/s
  const traffic::Fit range =
      traffic::parabola_fit(track.range, track.rate, dt, half_second, slope_weight);
  const std::vector<double> azimuth = traffic::line_fit(track.azimuth, dt, half_second).values;

  const double bumper = standard_ego.centre_x + side * 0.5 * standard_ego.length;
  std::vector<double> s;
  std::vector<double> d;
  std::vector<double> speed;
  for (std::size_t row = part.first; row <= part.last; ++row) {
    const std::size_t k = row - window.first;
    const std::size_t i = row - track.first_row;
    const Vec2 p_B{bumper + side * range.values[i] * std::cos(azimuth[i]),
                   range.values[i] * std::sin(azimuth[i])};
    const world::LanePose seen = to_lane(road, {from_lane(road, ego.path.poses[k]) * p_B, 0.0});
    s.push_back(seen.s + side * 0.5 * length);
    d.push_back(seen.d);
    speed.push_back(std::max(0.0, ego.speed[k] + side * range.slopes[i]));
  }
  const std::vector<double> forward = traffic::never_falling(s);
  const std::vector<double> steady_d = traffic::line_fit(d, dt, 2 * half_second).values;

  Rebuilt body{{}, treated(track, part)};
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double time = static_cast<double>(part.first - window.first + k) * dt;
    const Pose X_WA = from_lane(road, {forward[k], steady_d[k], 0.0});
    body.recording.push_back({rounded(time, 10.0), rounded_pose(X_WA), rounded_mm(speed[k]), 0.0});
    body.treated.largest_correction =
        std::max(body.treated.largest_correction, std::abs(forward[k] - s[k]));
  }
  return body;
}

ScenarioActor actor_of(const AssumedBody& body, std::uint8_t id, Recording recording) {
  return {.id = id,
          .kind = body.kind,
          .footprint = {world::Shape::box, body.length, body.width, 0.0},
          .mass = body.mass,
          .motion = std::move(recording)};
}

/// What the driver did, measured: the hardest braking, and when the brake lights came on for it.
DriverAction driver_action(const std::vector<traffic::HundredCarRow>& rows, const Window& window,
                           const std::vector<double>& speed) {
  const std::vector<double> slopes = traffic::line_fit(speed, dt, 2).slopes;
  const auto hardest = std::min_element(slopes.begin(), slopes.end()) - slopes.begin();
  DriverAction action;
  const auto k = static_cast<std::size_t>(hardest);
  action.deceleration = std::max(0.0, -slopes[k]);
  action.hardest_time = static_cast<double>(k) * dt;
  std::size_t row = window.first + k;
  if (rows[row].brake) {
    while (row > window.first && rows[row - 1].brake) {
      --row;
    }
    action.brake_time = static_cast<double>(row - window.first) * dt;
  }
  return action;
}

/// The rows kept: around the conflict, from when the vehicle ahead is seen. They go on when it is
/// not seen any more, for the vehicle behind.
Window window_of(const std::vector<traffic::HundredCarRow>& rows,
                 const traffic::HundredCarEvent& event, const HundredCarRequest& request,
                 const traffic::RadarTrack& lead) {
  const std::size_t start = row_at(rows, event.start_sync);
  const std::size_t before = std::min(start, steps(request.before));
  const std::size_t end = row_at(rows, event.end_sync) + steps(request.after);
  return {std::max(start - before, lead.first_row), std::min(end, rows.size() - 1)};
}

std::optional<traffic::RadarTrack> conflict_lead(const std::vector<traffic::HundredCarRow>& rows,
                                                 const traffic::HundredCarEvent& event) {
  const std::size_t around = steps(1.0);
  const std::size_t start = row_at(rows, event.start_sync);
  return traffic::lead_track(rows, start - std::min(start, around),
                             std::min(row_at(rows, event.end_sync) + around, rows.size() - 1));
}

struct Follower {
  ScenarioActor actor;
  TreatedTrack treated;
};

/// The vehicle behind, if the rear radar saw one for long enough.
std::optional<Follower> follower_of(const std::vector<traffic::HundredCarRow>& rows,
                                    const Window& window, std::size_t conflict,
                                    const EgoMotion& ego, const traffic::HundredCarEvent& event,
                                    const Scenario& scenario) {
  const std::optional<traffic::RadarTrack> track =
      traffic::follower_track(rows, window.first, window.last, conflict, fewest_follower_rows);
  if (!track) {
    return std::nullopt;
  }
  const bool described = event.third_place.starts_with("F = ");
  const AssumedBody body = assumed_body(described ? event.third_type : "Automobile");
  const std::uint8_t id = body.kind == scenario.actors.front().kind ? 2 : 1;
  Rebuilt behind = rebuilt(*track, window, ego, scenario.road, -1.0, body.length);
  return Follower{actor_of(body, id, std::move(behind.recording)), behind.treated};
}

Error no_lead(const HundredCarRequest& request, const std::string& why) {
  return {Error::Code::malformed,
          "event " + std::to_string(request.event) +
              ": want a lead target near the radar's axis around the conflict, got " + why};
}

}  // namespace

Result<HundredCarImport> rebuild_hundred_car(const std::vector<traffic::HundredCarRow>& rows,
                                             const traffic::HundredCarEvent& event,
                                             const HundredCarRequest& request) {
  expects(!rows.empty(), "there are rows");
  expects(request.before >= 1.0 && request.after >= 0.0, "before >= 1, after >= 0");
  const std::optional<traffic::RadarTrack> lead = conflict_lead(rows, event);
  if (!lead) {
    return no_lead(request, "none");
  }
  const Window window = window_of(rows, event, request, *lead);
  if (lead->last_row < window.first + fewest_lead_rows) {
    return no_lead(request, "one seen for less than 2 s");
  }
  const bool curved = event.alignment.starts_with("Curve");
  const std::size_t conflict =
      std::clamp(row_at(rows, event.start_sync), window.first, window.last);
  const Result<EgoMotion> motion = ego_motion(rows, window, conflict, curved);
  if (!motion.has_value()) {
    return Error{motion.error().code,
                 "event " + std::to_string(request.event) + ": " + motion.error().message};
  }
  const EgoMotion& ego = motion.value();

  HundredCarImport made;
  Scenario& scenario = made.scenario;
  HundredCarReport& report = made.report;
  scenario.road = road_of(event, ego.path.curvature);
  scenario.ego = ego_recording(ego, scenario.road);
  const AssumedBody lead_body = assumed_body(event.lead_type);
  Rebuilt ahead = rebuilt(*lead, window, ego, scenario.road, 1.0, lead_body.length);
  scenario.actors.push_back(actor_of(lead_body, 1, std::move(ahead.recording)));
  report.lead = ahead.treated;

  if (std::optional<Follower> behind = follower_of(rows, window, conflict, ego, event, scenario)) {
    scenario.actors.push_back(std::move(behind->actor));
    report.follower = behind->treated;
  }

  report.first_row = static_cast<std::int64_t>(window.first) + 1;
  report.last_row = static_cast<std::int64_t>(window.last) + 1;
  report.num_speed_missing = ego.num_speed_missing;
  report.gyro_bias = ego.path.gyro_bias;
  scenario.provenance = Provenance{request.event, report.first_row, report.last_row};
  scenario.duration = static_cast<double>(window.size() - 1) * dt + after_the_end;
  scenario.grip = assumed_grip(event.surface);
  describe(scenario, event, request, report, driver_action(rows, window, ego.speed));
  return made;
}

Result<HundredCarImport> import_hundred_car(const fs::path& path,
                                            const HundredCarRequest& request) {
  const HundredCarFiles files = find_hundred_car_files(path, request.event);
  if (!files.problem.empty()) {
    return Error{Error::Code::unreadable, files.problem};
  }
  const Result<std::string> table = read_file(files.table);
  if (!table.has_value()) {
    return table.error();
  }
  const Result<traffic::HundredCarEvent> event =
      traffic::read_hundred_car_event(table.value(), files.table.string(), request.event);
  if (!event.has_value()) {
    return event.error();
  }
  std::optional<Error> problem;
  for (const fs::path& file : files.series) {
    const Result<std::string> text = read_file(file);
    if (!text.has_value()) {
      return text.error();
    }
    const auto rows = traffic::read_hundred_car_rows(text.value(), file.string(), request.event);
    if (rows.has_value()) {
      return rebuild_hundred_car(rows.value(), event.value(), request);
    }
    problem = rows.error();
  }
  return *problem;
}

}  // namespace saca::sim

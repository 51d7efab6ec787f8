// Longer than 400 lines: the steps by which one event is rebuilt, each of which may refuse it, in
// the order in which they are taken.
#include "saca/lab/importers/hundred_car.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/lab/importers/hundred_car_ego.h"
#include "saca/lab/importers/hundred_car_judge.h"
#include "saca/lab/importers/hundred_car_words.h"
#include "saca/lab/recordings/radar_track.h"
#include "saca/lab/recordings/series.h"
#include "saca/lab/scenario/rounding.h"

namespace saca::importers {
namespace {

namespace fs = std::filesystem;

constexpr double dt = recordings::hundred_car_step;
constexpr std::size_t half_second = 5;  // rows
constexpr std::size_t fewest_follower_rows = 20;
constexpr std::size_t fewest_lead_rows = 20;
constexpr double after_the_end = 8.0;  // of the recording, for what SACA does instead [s]

/// Index of the row with a sync, clamped to the rows there are.
std::size_t row_at(const std::vector<recordings::HundredCarRow>& rows, std::int64_t sync) {
  const std::int64_t last = static_cast<std::int64_t>(rows.size()) - 1;
  return static_cast<std::size_t>(std::clamp(sync - rows.front().sync, std::int64_t{0}, last));
}

std::size_t steps(double seconds) {
  return static_cast<std::size_t>(std::lround(seconds / dt));
}

/// The ego's lane with what the videos say of the road.
/// @param num_right  lanes to the right of the ego's
world::Road road_of(const recordings::HundredCarEvent& event, double curvature, int num_right) {
  world::Road road;
  road.curvature = scenario::rounded(curvature, 1e6);
  road.lane_width = assumed_lane_width;
  const LanesAround lanes = lanes_around(event);
  const double half = 0.5 * assumed_lane_width;
  road.left_edge = half + (lanes.left - num_right) * assumed_lane_width;
  road.right_edge = -half - num_right * assumed_lane_width;
  road.left_beyond = lanes.divided ? world::Beyond::barrier : world::Beyond::unmarked;
  road.oncoming_left = lanes.oncoming_left;
  return road;
}

scenario::Recording ego_recording(const EgoMotion& ego, const world::Road& road) {
  scenario::Recording recording;
  for (std::size_t k = 0; k < ego.speed.size(); ++k) {
    const Pose X_WB = from_lane(road, ego.path.poses[k]);
    recording.push_back({scenario::rounded(static_cast<double>(k) * dt, 10.0),
                         scenario::rounded_pose(X_WB), scenario::rounded_mm(ego.speed[k]),
                         scenario::rounded_angle(ego.yaw_rate[k])});
  }
  return recording;
}

/// A radar's track as the motion of a body's centre, and how it was treated.
struct Rebuilt {
  scenario::Recording recording;
  TreatedTrack treated;
};

/// The part of a track that lies in the window.
RowRange common(const recordings::RadarTrack& track, const RowRange& window) {
  return {std::max(track.first_row, window.first), std::min(track.last_row, window.last)};
}

/// Whether the track and the window share so many rows.
bool overlap_for(const recordings::RadarTrack& track, const RowRange& window,
                 std::size_t num_rows) {
  const RowRange part = common(track, window);
  return part.first <= part.last && part.size() >= num_rows;
}

/// What was measured of a part of a track.
TreatedTrack treated(const recordings::RadarTrack& track, const RowRange& part) {
  TreatedTrack told;
  told.first_row = static_cast<std::int64_t>(part.first) + 1;
  told.last_row = static_cast<std::int64_t>(part.last) + 1;
  bool in_gap = false;
  for (std::size_t row = part.first; row <= part.last; ++row) {
    const std::size_t i = row - track.first_row;
    const bool seen = track.sightings[i] == recordings::Sighting::kept;
    told.num_seen += seen ? 1U : 0U;
    told.num_filled += seen ? 0U : 1U;
    told.num_outliers += track.sightings[i] == recordings::Sighting::outlier ? 1U : 0U;
    told.num_gaps += !seen && !in_gap ? 1U : 0U;
    in_gap = !seen;
    if (seen && (told.ids.empty() || told.ids.back() != track.ids[i])) {
      told.ids.push_back(track.ids[i]);
    }
  }
  told.rate_disagreement = recordings::rate_disagreement(track, part.first - track.first_row,
                                                         part.last - track.first_row);
  return told;
}

/// @param side    +1: the radar looks forward; -1: backward
/// @param length  of the body that is seen [m]
Rebuilt rebuilt(const recordings::RadarTrack& track, const RowRange& window, const EgoMotion& ego,
                const world::Road& road, double side, double length) {
  const RowRange part = common(track, window);
  constexpr double slope_weight = 1.0;  // [s^2]: noise of 0.3 m and 0.3 m/s
  const recordings::Fit range =
      recordings::parabola_fit(track.range, track.rate, dt, half_second, slope_weight);
  const std::vector<double> azimuth = recordings::line_fit(track.azimuth, dt, half_second).values;

  const double bumper =
      scenario::standard_ego.centre_x + side * 0.5 * scenario::standard_ego.length;
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
  const std::vector<double> forward = recordings::never_falling(s);
  const std::vector<double> steady_d = recordings::line_fit(d, dt, 2 * half_second).values;

  Rebuilt body{{}, treated(track, part)};
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double time = static_cast<double>(part.first - window.first + k) * dt;
    const Pose X_WA = from_lane(road, {forward[k], steady_d[k], 0.0});
    body.recording.push_back({scenario::rounded(time, 10.0), scenario::rounded_pose(X_WA),
                              scenario::rounded_mm(speed[k]), 0.0});
    body.treated.largest_correction =
        std::max(body.treated.largest_correction, std::abs(forward[k] - s[k]));
  }
  return body;
}

scenario::ScenarioActor actor_of(const AssumedBody& body, std::uint8_t id,
                                 scenario::Recording recording) {
  return {.id = id,
          .kind = body.kind,
          .footprint = {world::Shape::box, body.length, body.width, 0.0},
          .mass = body.mass,
          .motion = std::move(recording)};
}

/// What the driver did, measured: the hardest braking, and when the brake lights came on for it.
DriverAction driver_action(const std::vector<recordings::HundredCarRow>& rows,
                           const RowRange& window, const std::vector<double>& speed) {
  const std::vector<double> slopes = recordings::line_fit(speed, dt, 2).slopes;
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
RowRange window_of(const std::vector<recordings::HundredCarRow>& rows,
                   const recordings::HundredCarEvent& event, const HundredCarRequest& request,
                   const recordings::RadarTrack& lead) {
  const std::size_t start = row_at(rows, event.start_sync);
  const std::size_t before = std::min(start, steps(request.before));
  const std::size_t end = row_at(rows, event.end_sync) + steps(request.after);
  return {std::max(start - before, lead.first_row), std::min(end, rows.size() - 1)};
}

std::optional<recordings::RadarTrack> conflict_lead(
    const std::vector<recordings::HundredCarRow>& rows, const recordings::HundredCarEvent& event) {
  const std::size_t around = steps(1.0);
  const std::size_t start = row_at(rows, event.start_sync);
  return recordings::lead_track(rows, start - std::min(start, around),
                                std::min(row_at(rows, event.end_sync) + around, rows.size() - 1));
}

struct Follower {
  scenario::ScenarioActor actor;
  TreatedTrack treated;
};

/// The vehicle behind, if the rear radar saw one for long enough.
std::optional<Follower> follower_of(const std::vector<recordings::HundredCarRow>& rows,
                                    const RowRange& window, std::size_t conflict,
                                    const EgoMotion& ego, const recordings::HundredCarEvent& event,
                                    const scenario::Scenario& scenario) {
  const std::optional<recordings::RadarTrack> track =
      recordings::follower_track(rows, window.first, window.last, conflict, fewest_follower_rows);
  if (!track) {
    return std::nullopt;
  }
  const bool described = event.third_place.starts_with("F = ");
  const AssumedBody body = assumed_body(described ? event.third_type : "Automobile");
  const std::uint8_t id = body.kind == scenario.actors.front().kind ? 2 : 1;
  Rebuilt behind = rebuilt(*track, window, ego, scenario.road, -1.0, body.length);
  return Follower{actor_of(body, id, std::move(behind.recording)), behind.treated};
}

HundredCarRefusal no_lead(const HundredCarRequest& request, const std::string& why) {
  return refusal(request, HundredCarReason::no_lead,
                 "want a lead target near the radar's axis around the conflict, got " + why);
}

/// The scenario's rows, and the ego's motion along the lane that fits the time before the conflict.
struct LaneBeforeEvent {
  RowRange window;
  RowRange kept;
  EgoMotion ego;
};

/// Tries the longest time before the conflict first. Where the car's body does not stay in a lane
/// for so long, it came from elsewhere, and the scenario begins later.
std::variant<LaneBeforeEvent, HundredCarRefusal> lane_before(
    const std::vector<recordings::HundredCarRow>& rows, const recordings::HundredCarEvent& event,
    const HundredCarRequest& request, const RowRange& window) {
  const std::size_t conflict = std::min(row_at(rows, event.start_sync), window.last);
  constexpr double least_kept = 2.0;  // [s]
  if (conflict < steps(least_kept)) {
    return refusal(request, HundredCarReason::no_lane_before,
                   "want rows of at least 2 s before the conflict, got " +
                       shown(static_cast<double>(conflict) * dt, 1) + " s");
  }
  const bool curved = event.alignment.starts_with("Curve");
  constexpr double heading_room = 0.1;  // [m]: half a body of 4.7 m, turned by 2.4 deg
  const double body_in_lane =
      0.5 * (assumed_lane_width - scenario::standard_ego.width) - heading_room;
  std::optional<double> offset;
  for (const double kept_for : {std::max(12.0, request.before), 8.0, 5.0}) {
    const RowRange kept{conflict - std::min(conflict, steps(kept_for)), conflict};
    const RowRange part{std::max(window.first, kept.first), window.last};
    std::optional<EgoMotion> ego = ego_motion(rows, kept, part, curved);
    if (ego && ego->largest_offset <= body_in_lane) {
      return LaneBeforeEvent{part, kept, *std::move(ego)};
    }
    offset = ego ? ego->largest_offset : offset;
  }
  if (!offset) {
    return refusal(request, HundredCarReason::sensor_gap,
                   "want speed and yaw rate with gaps of at most 1.5 s, got longer ones in rows " +
                       std::to_string(window.first + 1) + " to " + std::to_string(window.last + 1));
  }
  return refusal(request, HundredCarReason::no_lane_before,
                 "want a driver who stays within " + shown(body_in_lane, 2) +
                     " m of the middle of a lane before the conflict, got " + shown(*offset, 2) +
                     " m from the one that fits best");
}

/// All bodies and words of the scenario.
HundredCarImport assembled(const std::vector<recordings::HundredCarRow>& rows,
                           const recordings::HundredCarEvent& event,
                           const HundredCarRequest& request, const recordings::RadarTrack& lead,
                           const LaneBeforeEvent& found, int num_right) {
  const RowRange& window = found.window;
  const EgoMotion& ego = found.ego;
  HundredCarImport made;
  scenario::Scenario& scenario = made.scenario;
  HundredCarReport& report = made.report;
  scenario.road = road_of(event, ego.path.curvature, num_right);
  scenario.ego = ego_recording(ego, scenario.road);
  const AssumedBody lead_body = assumed_body(event.lead_type);
  Rebuilt ahead = rebuilt(lead, window, ego, scenario.road, 1.0, lead_body.length);
  scenario.actors.push_back(actor_of(lead_body, 1, std::move(ahead.recording)));
  report.lead = ahead.treated;

  const std::size_t conflict =
      std::clamp(row_at(rows, event.start_sync), window.first, window.last);
  if (std::optional<Follower> behind = follower_of(rows, window, conflict, ego, event, scenario)) {
    scenario.actors.push_back(std::move(behind->actor));
    report.follower = behind->treated;
  }

  report.first_row = static_cast<std::int64_t>(window.first) + 1;
  report.last_row = static_cast<std::int64_t>(window.last) + 1;
  report.conflict_row = static_cast<std::int64_t>(conflict) + 1;
  report.num_speed_missing = ego.num_speed_missing;
  report.gyro_bias = ego.path.gyro_bias;
  report.curvature = scenario.road.curvature;
  report.kept_for = static_cast<double>(found.kept.size() - 1) * dt;
  report.keeping_rms = ego.path.keeping_rms;
  scenario.provenance = scenario::Provenance{request.event, report.first_row, report.last_row};
  scenario.duration = static_cast<double>(window.size() - 1) * dt + after_the_end;
  scenario.grip = assumed_grip(event.surface);
  describe(scenario, event, request, report, driver_action(rows, window, ego.speed));
  return made;
}

/// An event as the rows of a window tell it.
struct Attempt {
  std::variant<HundredCarImport, HundredCarRefusal> made;
  std::optional<std::size_t> departs_at;  ///< row in which the driver leaves the road
  bool to_the_right = false;              ///< likewise
};

/// @param num_right  lanes to the right of the ego's
Attempt attempt(const RowRange& window, int num_right,
                const std::vector<recordings::HundredCarRow>& rows,
                const recordings::HundredCarEvent& event, const HundredCarRequest& request,
                const recordings::RadarTrack& lead) {
  const auto lane = lane_before(rows, event, request, window);
  if (const auto* problem = std::get_if<HundredCarRefusal>(&lane)) {
    return {*problem};
  }
  const auto& found = std::get<LaneBeforeEvent>(lane);
  if (!overlap_for(lead, found.window, fewest_lead_rows)) {
    return {no_lead(request, "one seen for less than 2 s while the lane is kept and after")};
  }
  HundredCarImport made = assembled(rows, event, request, lead, found, num_right);
  if (is_struck(event) && !made.report.follower) {
    return {refusal(request, HundredCarReason::no_follower,
                    "want a target of the rear radar for 2 s in a conflict with the vehicle "
                    "behind, got none")};
  }
  if (const std::string problem = scenario_problem(made.scenario); !problem.empty()) {
    return {refusal(request, HundredCarReason::no_scenario, problem)};
  }
  if (auto wrong = contradiction(made.scenario, event, request)) {
    const auto& departure = wrong->departure;
    return {std::move(wrong->refusal),
            departure ? std::optional(found.window.first + steps(departure->time)) : std::nullopt,
            departure && departure->side == collision::Side::right};
  }
  return {std::move(made)};
}

}  // namespace

std::variant<HundredCarImport, HundredCarRefusal> judged_hundred_car(
    const std::vector<recordings::HundredCarRow>& rows, const recordings::HundredCarEvent& event,
    const HundredCarRequest& request) {
  constexpr double longest = 600.0;  // [s]
  expects(!rows.empty(), "there are rows");
  expects(request.before >= 1.0 && request.before <= longest && request.after >= 0.0 &&
              request.after <= longest,
          "before from 1 to 600, after from 0 to 600");
  if (auto problem = excluded(event, request)) {
    return *std::move(problem);
  }
  if (const std::string problem = impossible_value(rows); !problem.empty()) {
    return refusal(request, HundredCarReason::impossible_values, problem);
  }
  const std::optional<recordings::RadarTrack> lead = conflict_lead(rows, event);
  if (!lead) {
    return no_lead(request, "none");
  }
  RowRange window = window_of(rows, event, request, *lead);
  if (!overlap_for(*lead, window, fewest_lead_rows)) {
    return no_lead(request, "one seen for less than 2 s");
  }
  const std::size_t end = row_at(rows, event.end_sync);
  std::optional<HundredCarRefusal> departure;  // of the whole window, if he may only turn off
  for (;;) {
    Attempt made = attempt(window, 0, rows, event, request, *lead);
    if (made.departs_at && made.to_the_right && may_steer_into_right_lane(event)) {
      Attempt beside = attempt(window, 1, rows, event, request, *lead);
      made = beside.departs_at ? std::move(made) : std::move(beside);
    }
    const auto* problem = std::get_if<HundredCarRefusal>(&made.made);
    if (problem == nullptr) {
      return std::move(made.made);
    }
    if (!made.departs_at || *made.departs_at <= end) {
      return departure.value_or(*problem);
    }
    departure = departure.value_or(*problem);
    window.last = std::min(window.last, *made.departs_at) - 1;  // when all is over he may turn off
  }
}

Result<HundredCarImport> rebuild_hundred_car(const std::vector<recordings::HundredCarRow>& rows,
                                             const recordings::HundredCarEvent& event,
                                             const HundredCarRequest& request) {
  auto judged = judged_hundred_car(rows, event, request);
  if (const auto* problem = std::get_if<HundredCarRefusal>(&judged)) {
    return Error{Error::Code::malformed, problem->message};
  }
  return std::get<HundredCarImport>(std::move(judged));
}

Result<HundredCarImport> import_hundred_car(const fs::path& path,
                                            const HundredCarRequest& request) {
  const HundredCarFiles files = find_hundred_car_files(path, request.event);
  if (!files.problem.empty()) {
    return Error{Error::Code::unreadable, files.problem};
  }
  const Result<std::string> table = read_file(files.table, many_bytes);
  if (!table.has_value()) {
    return table.error();
  }
  const Result<recordings::HundredCarEvent> event =
      recordings::read_hundred_car_event(table.value(), files.table.string(), request.event);
  if (!event.has_value()) {
    return event.error();
  }
  Error problem{Error::Code::unreadable, path.string() + ": holds no series of the event"};
  for (const fs::path& file : files.series) {
    const Result<std::string> text = read_file(file, many_bytes);
    if (!text.has_value()) {
      return text.error();
    }
    const auto rows = recordings::read_hundred_car_rows(text.value(), file.string(), request.event);
    if (rows.has_value()) {
      return rebuild_hundred_car(rows.value(), event.value(), request);
    }
    problem = rows.error();
  }
  return problem;
}

}  // namespace saca::importers

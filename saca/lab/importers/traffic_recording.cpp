// Longer than 400 lines: what a file is refused for stands beside the step of importing that finds
// it, and the steps share what is known of the file so far.
#include "saca/lab/importers/traffic_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/importers/hundred_car_words.h"
#include "saca/lab/importers/smooth_track.h"
#include "saca/lab/importers/traffic_road.h"
#include "saca/lab/importers/traffic_words.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/scenario/rounding.h"

namespace saca::importers {
namespace {

constexpr double widest_gap = 1.5;                    // that is bridged [s]
constexpr double last_time = 590.0;                   // scenarios end at 600 s
constexpr double most_steps = 6000.0;                 // of a recording in a scenario
constexpr double fastest_of_all = 100.0;              // in a scenario [m/s]
constexpr double farthest_place = 1e5;                // of a scenario's coordinates [m]
constexpr double fastest_turn = from_degrees(360.0);  // [rad/s]
constexpr double farthest_of_all = 1000.0;            // from the ego [m]: nobody whom SACA meets
constexpr double straight_enough = 0.01;              // of a shape against its motion [rad]
constexpr double least_ego_time = 1.0;                // [s]

Error cannot_use(const recordings::CommonRoad& file, const std::string& message) {
  return {Error::Code::out_of_range, file.benchmark + ": " + message};
}

/// The file's coordinates and time as the scenario's.
struct Origin {
  Vec2 p_W;
  double time = 0.0;
  double step = 0.1;
};

/// The longest part of an obstacle's states without a gap that is too wide, as it stands in the
/// file: the motion of O.
scenario::Recording raw_recording(const recordings::Obstacle& obstacle, const Origin& origin) {
  const double last = std::min(last_time, origin.step * most_steps);
  scenario::Recording longest;
  scenario::Recording part;
  for (const recordings::ObstacleState& state : obstacle.states) {
    const double time = static_cast<double>(state.step) * origin.step - origin.time;
    if (time > last) {
      break;
    }
    if (!part.empty() && time - part.back().time > widest_gap) {
      part.clear();
    }
    part.push_back({time, {state.X_WO.p - origin.p_W, state.X_WO.yaw}, state.speed, 0.0});
    if (part.size() > longest.size()) {
      longest = part;
    }
  }
  return longest;
}

/// What is left of a smoothed track from the scenario's beginning on, in its file's digits.
scenario::Recording from_zero(const scenario::Recording& smooth, const Pose& X_OA) {
  constexpr double rounding = 1e-6;  // of times [s]
  scenario::Recording kept;
  for (const scenario::Sample& sample : smooth) {
    if (sample.time >= -rounding) {
      kept.push_back({std::max(0.0, scenario::rounded(sample.time, 1000.0)),
                      scenario::rounded_pose(sample.X_WA * X_OA),
                      scenario::rounded_mm(sample.speed),
                      scenario::rounded_angle(sample.yaw_rate)});
    }
  }
  return kept;
}

/// An obstacle on its way into the scenario.
struct Candidate {
  const recordings::Obstacle* obstacle = nullptr;
  scenario::ScenarioActor actor;
  SmoothTrack smooth;
  double nearness = std::numeric_limits<double>::infinity();  ///< least distance to the ego [m]
};

const scenario::Recording& recording_of(const Candidate& candidate) {
  return std::get<scenario::Recording>(candidate.actor.motion);
}

/// A body that stands there as long as anything may happen.
scenario::Recording standing(const recordings::Obstacle& obstacle, const Origin& origin) {
  const recordings::ObstacleState& state = obstacle.states.front();
  const Pose X_WA =
      scenario::rounded_pose(Pose{state.X_WO.p - origin.p_W, state.X_WO.yaw} * obstacle.X_OA);
  return {{0.0, X_WA, 0.0, 0.0}, {last_time, X_WA, 0.0, 0.0}};
}

/// @return  why the obstacle cannot be in the scenario; empty when it can
std::string make_recording(const recordings::Obstacle& obstacle, const Origin& origin,
                           Candidate& made) {
  const world::Footprint& body = obstacle.footprint;
  if (body.length < 0.1 || body.length > 40.0 || body.width < 0.1 || body.width > 20.0) {
    return "of no size that a scenario may have";
  }
  const TrafficBody assumed = assumed_traffic_body(obstacle);
  made.obstacle = &obstacle;
  made.actor = {.kind = assumed.kind, .footprint = body, .mass = assumed.mass};
  if (!obstacle.dynamic) {
    made.actor.motion = standing(obstacle, origin);
    return "";
  }
  if (std::abs(obstacle.X_OA.yaw) > straight_enough) {
    return "with a shape that is turned against its motion";
  }
  const scenario::Recording raw = raw_recording(obstacle, origin);
  if (raw.size() < fewest_samples) {
    return "seen for less than 0.5 s";
  }
  made.smooth = smooth_track(raw, origin.step);
  if (made.smooth.hardest > hardest_possible) {
    return "moving harder than any tyre can";
  }
  for (const scenario::Sample& sample : made.smooth.samples) {
    if (sample.speed > fastest_of_all || std::abs(sample.yaw_rate) > fastest_turn) {
      return "moving faster than a scenario may";
    }
    if (std::max(std::abs(sample.X_WA.p.x), std::abs(sample.X_WA.p.y)) > farthest_place) {
      return "farther away than a scenario's coordinates go";
    }
  }
  made.actor.motion = from_zero(made.smooth.samples, obstacle.X_OA);
  return recording_of(made).size() < 2 ? "gone before the start" : "";
}

/// Where the ego's recording has the body's centre, as motion of the centre of mass.
scenario::Recording ego_recording_of(const scenario::Recording& centre) {
  scenario::Recording recording = centre;
  for (scenario::Sample& sample : recording) {
    sample.X_WA =
        scenario::rounded_pose(sample.X_WA * Pose{{-scenario::standard_ego.centre_x, 0.0}, 0.0});
  }
  return recording;
}

/// Least distance between the ego, on its expected way, and an actor.
double nearness_of(const scenario::Scenario& scenario, const scenario::Recording& recording) {
  double least = std::numeric_limits<double>::infinity();
  for (const scenario::Sample& sample : recording) {
    least = std::min(least, norm(sample.X_WA.p - scenario::ego_at(scenario, sample.time).X_WB.p));
  }
  return least;
}

bool touches(const world::Footprint& a, const Pose& X_WA, const world::Footprint& b,
             const Pose& X_WB) {
  return world::separation(a, X_WA, b, X_WB).distance <= 0.0;
}

/// @return  why an actor must stay out beside those that are in; empty when it may come in
std::string conflict_with(const scenario::Scenario& scenario, const Candidate& candidate) {
  if (candidate.nearness > farthest_of_all) {
    return "farther than 1 km";
  }
  const scenario::Sample& first = recording_of(candidate).front();
  const world::Footprint& body = candidate.actor.footprint;
  if (first.time > 0.0) {
    const Pose X_WB = scenario::ego_at(scenario, first.time).X_WB;
    return touches(scenario::standard_ego, X_WB, body, first.X_WA) ? "appearing inside the ego"
                                                                   : "";
  }
  for (const scenario::ScenarioActor& other : scenario.actors) {
    const scenario::Sample& there = std::get<scenario::Recording>(other.motion).front();
    if (there.time == 0.0 && touches(body, first.X_WA, other.footprint, there.X_WA)) {
      return "touching a nearer one at the start";
    }
  }
  return scenario.actors.size() == world::max_actors ? "farther than the nearest 32" : "";
}

/// Everybody but the ego who can be there, the nearest first; the others are counted.
std::vector<Candidate> candidates_of(const recordings::CommonRoad& file,
                                     const TrafficRequest& request, const Origin& origin,
                                     const scenario::Scenario& scenario, TrafficReport& report) {
  std::vector<Candidate> candidates;
  for (const recordings::Obstacle& obstacle : file.obstacles) {
    if (request.ego == obstacle.id) {
      continue;
    }
    Candidate candidate;
    const std::string reason = make_recording(obstacle, origin, candidate);
    if (!reason.empty()) {
      ++report.left_out[reason];
      continue;
    }
    candidate.nearness = nearness_of(scenario, recording_of(candidate));
    candidates.push_back(std::move(candidate));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.nearness < b.nearness; });
  return candidates;
}

/// Adds up what smoothing did to those who are in.
struct Smoothing {
  double squares = 0.0;
  double samples = 0.0;
  void add(const SmoothTrack& track, TrafficReport& report) {
    const auto size = static_cast<double>(track.samples.size());
    squares += size * track.rms_shift * track.rms_shift;
    samples += size;
    report.num_filled += track.num_filled;
    report.num_outliers += track.num_outliers;
    report.largest_shift = std::max(report.largest_shift, track.largest_shift);
    report.hardest = std::max(report.hardest, track.hardest);
    report.rms_shift = samples > 0.0 ? std::sqrt(squares / samples) : 0.0;
  }
};

/// Lets in whom there is room for. @return  the error of an actor that touches the ego
std::optional<Error> add_actors(const recordings::CommonRoad& file,
                                std::vector<Candidate> candidates, Smoothing smoothing,
                                TrafficImport& made) {
  scenario::Scenario& scenario = made.scenario;
  const Pose X_WB = scenario::ego_at(scenario, 0.0).X_WB;
  std::map<world::ActorKind, std::uint8_t> num_of_kind;
  for (Candidate& candidate : candidates) {
    const scenario::Sample& first = recording_of(candidate).front();
    if (first.time == 0.0 &&
        touches(scenario::standard_ego, X_WB, candidate.actor.footprint, first.X_WA)) {
      return cannot_use(file, "want room around the ego at the start, got obstacle " +
                                  std::to_string(candidate.obstacle->id) +
                                  " touching it; choose another ego or time");
    }
    const std::string reason = conflict_with(scenario, candidate);
    if (!reason.empty()) {
      ++made.report.left_out[reason];
      continue;
    }
    candidate.actor.id = ++num_of_kind[candidate.actor.kind];
    made.report.actors.push_back(
        {std::string(world::name(candidate.actor.kind)) + std::to_string(candidate.actor.id),
         candidate.obstacle->id});
    if (candidate.obstacle->dynamic) {
      smoothing.add(candidate.smooth, made.report);
    }
    scenario.actors.push_back(std::move(candidate.actor));
  }
  return std::nullopt;
}

/// The ego and its lane; the origin's place is set here.
struct EgoOfFile {
  Origin origin;
  std::variant<scenario::EgoStart, scenario::Recording> ego;
  recordings::LaneFit lane;
  world::Road road;
  SmoothTrack smooth;  ///< empty for a planning problem
};

Vec2 whole_metres(Vec2 p) {
  return {std::floor(p.x), std::floor(p.y)};
}

Result<EgoOfFile> planned_ego(const recordings::CommonRoad& file, const TrafficRequest& request) {
  if (file.problems.empty()) {
    return cannot_use(file, "want a planning problem or an obstacle for the ego, got neither");
  }
  const recordings::ObstacleState& start = file.problems.front().start;
  const double time = static_cast<double>(start.step) * file.time_step;
  if (request.from && std::abs(*request.from - time) > 0.5 * file.time_step) {
    return cannot_use(file, "want an obstacle for the ego when it is to begin at " +
                                std::to_string(*request.from) +
                                " s, got none: the planning problem's start is known at " +
                                std::to_string(time) + " s only");
  }
  if (start.speed < 0.0 || start.speed > 100.0) {
    return cannot_use(file, "want a planning problem that starts with 0 to 100 m/s, got " +
                                std::to_string(start.speed) + " m/s");
  }
  const Result<recordings::LaneFit> lane = recordings::fit_lane(file, start.X_WO, {});
  if (!lane.has_value()) {
    return cannot_use(file, lane.error().message);
  }
  EgoOfFile made{{whole_metres(start.X_WO.p), time, file.time_step},
                 scenario::EgoStart{},
                 lane.value(),
                 {},
                 {}};
  made.road = moved_road(made.lane.road, -made.origin.p_W);
  const Pose X_WC{start.X_WO.p - made.origin.p_W, start.X_WO.yaw};
  world::LanePose pose =
      to_lane(made.road, X_WC * Pose{{-scenario::standard_ego.centre_x, 0.0}, 0.0});
  pose = {scenario::rounded_mm(pose.s), scenario::rounded_mm(pose.d), 0.0};
  made.ego = scenario::EgoStart{pose, scenario::rounded_mm(start.speed)};
  return made;
}

Result<EgoOfFile> recorded_ego_of(const recordings::CommonRoad& file,
                                  const TrafficRequest& request) {
  const auto found = std::find_if(file.obstacles.begin(), file.obstacles.end(),
                                  [&](const recordings::Obstacle& obstacle) {
                                    return obstacle.id == *request.ego && obstacle.dynamic;
                                  });
  const std::string who = "obstacle " + std::to_string(*request.ego);
  if (found == file.obstacles.end()) {
    return cannot_use(
        file, "want the id of a dynamic obstacle for the ego, got " + std::to_string(*request.ego));
  }
  EgoOfFile made;
  made.origin.step = file.time_step;
  made.origin.p_W = whole_metres(found->states.front().X_WO.p);
  made.origin.time =
      request.from.value_or(static_cast<double>(found->states.front().step) * file.time_step);
  Candidate candidate;
  const std::string reason = make_recording(*found, made.origin, candidate);
  if (!reason.empty()) {
    return cannot_use(file, "want an ego that can be played, got " + who + ", " + reason);
  }
  const scenario::Recording& recording = recording_of(candidate);
  if (recording.front().time > 0.0 || recording.back().time < least_ego_time) {
    return cannot_use(file, "want an ego that is recorded from " +
                                std::to_string(made.origin.time) + " s on for 1 s or more, got " +
                                who + ": its recording there is not");
  }
  std::vector<Vec2> way_W;
  for (const scenario::Sample& sample : recording) {
    way_W.push_back(sample.X_WA.p + made.origin.p_W);
  }
  const Result<recordings::LaneFit> lane =
      recordings::fit_lane(file, {way_W.front(), recording.front().X_WA.yaw}, way_W);
  if (!lane.has_value()) {
    return cannot_use(file, who + ": " + lane.error().message);
  }
  made.lane = lane.value();
  made.road = moved_road(made.lane.road, -made.origin.p_W);
  made.ego = ego_recording_of(recording);
  made.smooth = candidate.smooth;
  return made;
}

double last_sample(const scenario::Scenario& scenario) {
  if (const auto* ego = std::get_if<scenario::Recording>(&scenario.ego)) {
    return ego->back().time;
  }
  double last = 0.0;
  for (const scenario::ScenarioActor& actor : scenario.actors) {
    const scenario::Sample& sample = std::get<scenario::Recording>(actor.motion).back();
    last = sample.time < last_time ? std::max(last, sample.time) : last;
  }
  return last;
}

}  // namespace

Result<TrafficImport> traffic_scenario(const recordings::CommonRoad& file,
                                       const TrafficRequest& request) {
  const Result<EgoOfFile> found =
      request.ego ? recorded_ego_of(file, request) : planned_ego(file, request);
  if (!found.has_value()) {
    return found.error();
  }
  const EgoOfFile& ego = found.value();
  TrafficImport made;
  scenario::Scenario& scenario = made.scenario;
  TrafficReport& report = made.report;
  scenario.road = ego.road;
  const bool crossing =
      std::find(file.tags.begin(), file.tags.end(), "intersection") != file.tags.end();
  scenario.road.topology = crossing ? world::Topology::intersection : world::Topology::straight;
  scenario.ego = ego.ego;
  report.from = ego.origin.time;
  report.origin_W = ego.origin.p_W;
  report.lane = ego.lane;
  report.ignored = file.ignored;
  Smoothing smoothing;
  if (request.ego) {
    smoothing.add(ego.smooth, report);
  }
  std::vector<Candidate> candidates = candidates_of(file, request, ego.origin, scenario, report);
  if (std::optional<Error> error = add_actors(file, std::move(candidates), smoothing, made)) {
    return *error;
  }
  const world::Road wide = widened_road(scenario, report.lane.behind, report.lane.ahead);
  report.widened_left = wide.left_edge - scenario.road.left_edge;
  report.widened_right = scenario.road.right_edge - wide.right_edge;
  scenario.road = wide;
  scenario.grip = assumed_grip("Dry");
  scenario.duration = std::clamp(last_sample(scenario) + request.after, 1.0, last_time);
  describe(scenario, file, request, report);
  return made;
}

Result<TrafficImport> import_commonroad(const std::filesystem::path& path,
                                        const TrafficRequest& request) {
  const Result<std::string> text = read_file(path, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  const Result<recordings::CommonRoad> file =
      recordings::read_commonroad(text.value(), path.string());
  if (!file.has_value()) {
    return file.error();
  }
  Result<TrafficImport> made = traffic_scenario(file.value(), request);
  if (!made.has_value()) {
    return Error{made.error().code, path.string() + ": " + made.error().message};
  }
  return made;
}

}  // namespace saca::importers

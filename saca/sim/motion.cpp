#include "saca/sim/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/core/contract.h"

namespace saca::sim {
namespace {

/// A recorded body slower than this at the end of its recording has stopped: the noise of a radar's
/// range rate at rest, by eye.
constexpr double rest_speed = 0.3;

/// Way made from 0 to `time` [m].
double way(const Script& script, double time) {
  const double v = script.speed;
  const double coasting = script.behaviour == Behaviour::brake ? std::min(time, script.from) : 0.0;
  double a = 0.0;
  switch (script.behaviour) {
    case Behaviour::hold:
      return 0.0;
    case Behaviour::constant_velocity:
      return v * time;
    case Behaviour::accelerate:
      a = script.acceleration;
      break;
    case Behaviour::brake:
      a = -script.acceleration;
      break;
  }
  double t = time - coasting;
  if (a < 0.0) {
    t = std::min(t, v / -a);
  }
  return v * coasting + v * t + 0.5 * a * t * t;
}

Pose scripted_pose(const world::Road& road, const Script& script, double time) {
  const double made = way(script, time);
  const world::LanePose& start = script.start;
  const bool along = start.heading == 0.0;
  const bool against = std::abs(start.heading) == std::numbers::pi;
  if (along || against) {
    // At the offset d the same way sweeps more or less of the centre line.
    const double scale = 1.0 - road.curvature * start.d;
    const double s = start.s + (along ? made : -made) / scale;
    return from_lane(road, {s, start.d, start.heading});
  }
  const Pose X_WA = from_lane(road, start);
  return {X_WA * Vec2{made, 0.0}, X_WA.yaw};
}

Pose recorded_pose(const Recording& recording, double time) {
  const Sample& last = recording.back();
  if (time >= last.time) {
    const double made = last.speed < rest_speed ? 0.0 : last.speed * (time - last.time);
    return {last.X_WA * Vec2{made, 0.0}, last.X_WA.yaw};
  }
  const auto after = std::upper_bound(recording.begin(), recording.end(), time,
                                      [](double t, const Sample& s) { return t < s.time; });
  if (after == recording.begin()) {
    return recording.front().X_WA;
  }
  const Sample& a = *(after - 1);
  const Sample& b = *after;
  return between(a.X_WA, b.X_WA, (time - a.time) / (b.time - a.time));
}

world::EgoState recorded_ego(const Recording& recording, double time) {
  world::EgoState ego;
  ego.X_WB = recorded_pose(recording, time);
  const Sample& last = recording.back();
  if (time >= last.time) {
    ego.v_B.x = last.speed < rest_speed ? 0.0 : last.speed;
    return ego;
  }
  const auto after = std::upper_bound(recording.begin() + 1, recording.end(), time,
                                      [](double t, const Sample& s) { return t < s.time; });
  const Sample& a = *(after - 1);
  const Sample& b = *after;
  const double span = b.time - a.time;
  const double share = (time - a.time) / span;
  ego.v_B.x = a.speed + share * (b.speed - a.speed);
  ego.yaw_rate = a.yaw_rate + share * (b.yaw_rate - a.yaw_rate);
  ego.a_B = {(b.speed - a.speed) / span, ego.v_B.x * ego.yaw_rate};
  return ego;
}

}  // namespace

world::Track actor_track(const Scenario& scenario, std::size_t actor, double step) {
  expects(actor < scenario.actors.size(), "actor < number of actors");
  expects(step > 0.0, "step > 0");
  const ScenarioActor& body = scenario.actors[actor];
  const auto* recording = std::get_if<Recording>(&body.motion);
  expects(recording == nullptr || !recording->empty(), "a recording has samples");

  world::Track track;
  track.start = recording == nullptr ? 0.0 : recording->front().time;
  track.step = step;
  const double span = std::max(0.0, scenario.duration - track.start);
  const auto num_steps = static_cast<std::size_t>(std::ceil(span / step - 1e-9));
  track.X_WA.reserve(num_steps + 1);
  for (std::size_t k = 0; k <= num_steps; ++k) {
    const double time = track.start + static_cast<double>(k) * step;
    track.X_WA.push_back(recording == nullptr
                             ? scripted_pose(scenario.road, std::get<Script>(body.motion), time)
                             : recorded_pose(*recording, time));
  }
  return track;
}

world::EgoState ego_at(const Scenario& scenario, double time) {
  expects(time >= 0.0, "time >= 0");
  if (const auto* recording = std::get_if<Recording>(&scenario.ego)) {
    expects(recording->size() >= 2, "a recording of the ego has at least two samples");
    return recorded_ego(*recording, time);
  }
  const auto& [start, speed] = std::get<EgoStart>(scenario.ego);
  const Script script{.start = start, .speed = speed};
  world::EgoState ego;
  ego.X_WB = scripted_pose(scenario.road, script, time);
  ego.v_B = {speed, 0.0};
  if (start.heading == 0.0) {
    const double curvature = scenario.road.curvature;
    ego.yaw_rate = speed * curvature / (1.0 - curvature * start.d);
  }
  ego.a_B = {0.0, ego.yaw_rate * speed};
  return ego;
}

}  // namespace saca::sim

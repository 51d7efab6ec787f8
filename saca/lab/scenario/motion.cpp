#include "saca/lab/scenario/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/base/core/quintic.h"
#include "saca/base/core/units.h"

namespace saca::scenario {
namespace {

/// A recorded body slower than this at the end of its recording has stopped: the noise of a radar's
/// range rate at rest, by eye.
constexpr double rest_speed = 0.3;

/// How hard somebody who walks stops or starts to run [m/s^2]: an assumption; a walk of 1.5 m/s
/// ends within half a second and 40 cm.
constexpr double walking_acceleration = 3.0;

/// Speed along a line: constant, then changing evenly, then constant again.
struct SpeedProfile {
  double speed = 0.0;         ///< at first [m/s]
  double from = 0.0;          ///< [s]
  double acceleration = 0.0;  ///< [m/s^2]
  double last = 0.0;          ///< in the end [m/s]

  /// Way made from 0 to `time` [m].
  [[nodiscard]] double way(double time) const {
    if (time <= from || acceleration == 0.0) {
      return speed * time;
    }
    const double t = time - from;
    const double changing = std::min(t, std::max(0.0, (last - speed) / acceleration));
    const double way = speed * (from + changing) + 0.5 * acceleration * changing * changing;
    return changing < t ? way + last * (t - changing) : way;
  }
};

Deed deed_of(const Script& script, const std::optional<double>& choice) {
  if (!choice || (!script.chance_stop && !script.chance_run)) {
    return script.then;
  }
  const double stop = script.chance_stop.value_or(0.0);
  if (*choice < stop) {
    return Deed::stop;
  }
  return *choice < stop + script.chance_run.value_or(0.0) ? Deed::run : Deed::go_on;
}

constexpr double endless = std::numeric_limits<double>::infinity();

/// @param braking  the hardest that the road allows [m/s^2]
SpeedProfile speed_of(const Script& script, const ActorChance& chance, double braking = endless) {
  SpeedProfile profile{.speed = script.speed, .from = std::max(0.0, script.from + chance.delay)};
  switch (script.behaviour) {
    case Behaviour::hold:
      profile.speed = 0.0;
      break;
    case Behaviour::constant_velocity:
    case Behaviour::follow:
      break;
    case Behaviour::accelerate:
      profile.acceleration = std::max(-braking, chance.strength * script.acceleration);
      profile.last = script.until_speed.value_or(script.acceleration < 0.0 ? 0.0 : endless);
      break;
    case Behaviour::brake:
    case Behaviour::lane_change:
      profile.acceleration = -std::min(braking, chance.strength * script.acceleration);
      break;
    case Behaviour::walk:
      switch (deed_of(script, chance.choice)) {
        case Deed::stop:
          profile.acceleration = -chance.strength * walking_acceleration;
          break;
        case Deed::go_on:
          break;
        case Deed::run:
          profile.acceleration = chance.strength * walking_acceleration;
          profile.last = script.run_speed;
          break;
      }
      break;
  }
  return profile;
}

/// How far aside a lane change is, and how far it was on average since the start.
struct Aside {
  double d = 0.0;       ///< [m]
  double mean_d = 0.0;  ///< over the way made [m]
  double slope = 0.0;   ///< [-]
};

Aside aside(const Script& script, const SpeedProfile& speed, double time) {
  const double d = script.start.d;
  if (script.behaviour != Behaviour::lane_change || time <= speed.from) {
    return {d, d, 0.0};
  }
  const double change = script.to_d - d;
  const double way = speed.way(time);
  const double begun = speed.way(speed.from);
  const double takes = speed.way(speed.from + script.takes) - begun;  // [m]
  const double x = std::min(1.0, (way - begun) / takes);
  const double slope = quintic_slope(x) / takes;
  const double sum = takes * x * x * x * x * (2.5 + x * (-3.0 + x)) +
                     std::max(0.0, way - begun - takes);  // of the share over the way
  return {d + change * quintic(x), d + change * sum / way, change * slope};
}

/// How hard an actor brakes at most, in its own time: with the grip that the road really has. As
/// written a script may ask for more than its scenario's grip; drawn, it gets no more of that
/// [m/s^2].
double hardest_braking(const Scenario& scenario, const Script& script, const Chance& chance,
                       const ActorChance& actor) {
  const double written = std::max(from_g(scenario.grip), std::abs(script.acceleration));
  return written * chance.car.grip / (actor.speed * actor.speed);
}

Pose scripted_pose(const world::Road& road, const Script& script, double time,
                   const ActorChance& chance, double braking = endless) {
  const SpeedProfile speed = speed_of(script, chance, braking);
  const double made = speed.way(time);
  const world::LanePose& start = script.start;
  const bool along = start.heading == 0.0;
  const bool against = std::abs(start.heading) == std::numbers::pi;
  if (along || against) {
    const auto [d, mean_d, slope] = aside(script, speed, time);
    // At the offset d the same way sweeps more or less of the centre line.
    const double scale = 1.0 - road.curvature * mean_d;
    const double s = start.s + (along ? made : -made) / scale;
    const double turned = along ? std::atan(slope) : -std::atan(slope);
    return from_lane(road, {s, d, start.heading + turned});
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

double own_time(double time, const ActorChance& chance, double from) {
  return time <= from ? time : from + (time - from) * chance.speed;
}

bool reacts(const ScenarioActor& actor) {
  const auto* script = std::get_if<Script>(&actor.motion);
  return script != nullptr && script->behaviour == Behaviour::follow;
}

Pose start_pose(const Scenario& scenario, std::size_t actor) {
  expects(actor < scenario.actors.size(), "actor < number of actors");
  const ScenarioActor& body = scenario.actors[actor];
  if (const auto* recording = std::get_if<Recording>(&body.motion)) {
    expects(!recording->empty(), "a recording has samples");
    return recording->front().X_WA;
  }
  return from_lane(scenario.road, std::get<Script>(body.motion).start);
}

double appears_at(const Scenario& scenario, std::size_t actor, const Chance& chance) {
  expects(actor < scenario.actors.size(), "actor < number of actors");
  const auto* recording = std::get_if<Recording>(&scenario.actors[actor].motion);
  if (recording == nullptr) {
    return 0.0;
  }
  expects(!recording->empty(), "a recording has samples");
  const double time = recording->front().time;
  return time <= chance.from ? time
                             : chance.from + (time - chance.from) / chance.actors[actor].speed;
}

Pose actor_pose(const Scenario& scenario, std::size_t actor, double time, const Chance& chance) {
  expects(actor < scenario.actors.size(), "actor < number of actors");
  expects(time >= 0.0, "time >= 0");
  const ScenarioActor& body = scenario.actors[actor];
  expects(!reacts(body), "an actor that does not react");
  const ActorChance& drawn = chance.actors[actor];
  const double own = own_time(time, drawn, chance.from);
  const auto* recording = std::get_if<Recording>(&body.motion);
  expects(recording == nullptr || !recording->empty(), "a recording has samples");
  const auto* script = std::get_if<Script>(&body.motion);
  const Pose X_WA = script != nullptr
                        ? scripted_pose(scenario.road, *script, own, drawn,
                                        hardest_braking(scenario, *script, chance, drawn))
                        : recorded_pose(*recording, own);
  return {X_WA * Vec2{drawn.ahead, drawn.aside}, X_WA.yaw};
}

world::Track actor_track(const Scenario& scenario, std::size_t actor, double step,
                         const Chance& chance) {
  expects(step > 0.0, "step > 0");
  world::Track track;
  track.start = appears_at(scenario, actor, chance);
  track.step = step;
  const double span = std::max(0.0, scenario.duration - track.start);
  const auto num_steps = static_cast<std::size_t>(std::ceil(span / step - 1e-9));
  track.X_WA.reserve(num_steps + 1);
  for (std::size_t k = 0; k <= num_steps; ++k) {
    const double time = track.start + static_cast<double>(k) * step;
    track.X_WA.push_back(actor_pose(scenario, actor, time, chance));
  }
  return track;
}

double steepest_slope(const Script& script) {
  expects(script.takes > 0.0 && script.speed > 0.0, "a lane change takes time and moves");
  const SpeedProfile speed = speed_of(script, {});
  const double takes = speed.way(script.from + script.takes) - speed.way(script.from);
  return 1.875 * std::abs(script.to_d - script.start.d) / takes;  // the quintic's, at its middle
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
  ego.X_WB = scripted_pose(scenario.road, script, time, {});
  ego.v_B = {speed, 0.0};
  if (start.heading == 0.0) {
    const double curvature = scenario.road.curvature;
    ego.yaw_rate = speed * curvature / (1.0 - curvature * start.d);
  }
  ego.a_B = {0.0, ego.yaw_rate * speed};
  return ego;
}

}  // namespace saca::scenario

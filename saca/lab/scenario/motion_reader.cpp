#include "saca/lab/scenario/motion_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "saca/base/core/units.h"
#include "saca/lab/scenario/motion.h"

namespace saca::scenario {
namespace {

using config::Range;
using config::Table;

constexpr Range yaw_rate_range{-360.0, 360.0};   // [deg/s]
constexpr Range deceleration_range{0.01, 15.0};  // [m/s^2]
constexpr Range probability_range{0.0, 1.0};
constexpr std::size_t max_samples = 6001;

bool follows_the_lane(const Script& script) {
  return script.start.heading == 0.0 || std::abs(script.start.heading) == std::numbers::pi;
}

void want_along_the_lane(const Script& script, Table& table) {
  if (!follows_the_lane(script)) {
    table.reject("heading_deg", "want 0 or 180, along the lane, for this behaviour, got " +
                                    std::to_string(to_degrees(script.start.heading)));
  }
}

void read_accelerate(Script& script, Table& table) {
  script.acceleration = table.number("acceleration_mps2", {-15.0, 15.0});
  script.from = table.optional_number("from_s", time_range).value_or(0.0);
  script.until_speed = table.optional_number("until_mps", speed_range);
  if (script.until_speed && (*script.until_speed - script.speed) * script.acceleration < 0.0) {
    table.reject("until_mps", "want a speed that the acceleration leads to, got " +
                                  std::to_string(*script.until_speed));
  }
}

void read_lane_change(Script& script, Table& table) {
  want_along_the_lane(script, table);
  script.to_d = table.number("to_d_m", position_range);
  script.from = table.number("begins_at_s", time_range);
  script.takes = table.number("takes_s", {0.1, 60.0});
  script.acceleration =
      table.optional_number("deceleration_mps2", deceleration_range).value_or(0.0);
  if (!(script.speed > 0.0)) {
    table.reject("speed_mps", "want more than 0 for a lane change, got 0");
    return;
  }
  const double steepest = steepest_slope(script);
  constexpr double most = 1.0;  // 45 degrees across the lane: no vehicle drives farther round
  if (!(steepest <= most)) {
    table.reject("takes_s",
                 "want a lane change that heads at most 45 degrees across the lane, got " +
                     std::to_string(to_degrees(std::atan(steepest))));
  }
}

void read_follow(Script& script, Table& table, world::ActorKind kind) {
  if (kind == world::ActorKind::pedestrian || kind == world::ActorKind::obstacle) {
    table.reject("behaviour", "want a vehicle that follows, got a " + std::string(name(kind)));
  }
  want_along_the_lane(script, table);
  drivers::DriverLaw& law = script.law;
  law = drivers::usual_driver(script.speed);
  law.desired_speed = table.number("desired_speed_mps", {0.1, 100.0});
  law.time_gap = table.number("time_gap_s", {0.0, 10.0});
  law.reaction = table.number("reaction_s", {0.0, drivers::longest_reaction});
  const auto optional = [&](std::string_view key, Range range, double& value) {
    value = table.optional_number(key, range).value_or(value);
  };
  optional("least_gap_m", {0.1, 50.0}, law.least_gap);
  optional("acceleration_mps2", {0.01, 15.0}, law.acceleration);
  optional("comfortable_mps2", deceleration_range, law.comfortable);
  optional("hardest_mps2", deceleration_range, law.hardest);
}

void read_walk(Script& script, Table& table, world::ActorKind kind) {
  if (kind != world::ActorKind::pedestrian && kind != world::ActorKind::bicycle) {
    table.reject("behaviour",
                 "want a pedestrian or bicycle that walks, got a " + std::string(name(kind)));
  }
  script.from = table.number("decides_at_s", time_range);
  script.then = read_word(table, "then", deed_from, "stop, go_on, run");
  script.chance_stop = table.optional_number("chance_stop", probability_range);
  script.chance_run = table.optional_number("chance_run", probability_range);
  if (script.chance_stop.value_or(0.0) + script.chance_run.value_or(0.0) > 1.0) {
    table.reject(script.chance_run ? "chance_run" : "chance_stop",
                 "want chance_stop and chance_run to be 1 together at most, got " +
                     std::to_string(*script.chance_stop + *script.chance_run));
  }
  if (script.then == Deed::run || script.chance_run.value_or(0.0) > 0.0 || table.has("run_mps")) {
    script.run_speed = table.number("run_mps", {0.1, 15.0});
    if (script.run_speed < script.speed) {
      table.reject("run_mps",
                   "want no less than speed_mps, got " + std::to_string(script.run_speed));
    }
  }
}

}  // namespace

double read_angle(Table& table, std::string_view key) {
  return wrap_angle(from_degrees(table.number(key, heading_range)));
}

world::LanePose read_lane_pose(Table& table) {
  world::LanePose pose;
  pose.s = table.number("s_m", position_range);
  pose.d = table.number("d_m", position_range);
  pose.heading = read_angle(table, "heading_deg");
  return pose;
}

bool is_recorded(Table& table) {
  const bool recorded = table.has("recording");
  if (recorded && table.has("start")) {
    table.reject("start", "want either a start or a recording, got both");
  }
  return recorded;
}

Recording read_recording(Table table) {
  const std::vector<double> times = table.numbers("t_s", time_range);
  if (times.size() < 2 || times.size() > max_samples) {
    table.reject("t_s", "want 2 to " + std::to_string(max_samples) + " samples, got " +
                            std::to_string(times.size()));
    return {{}, {}};
  }
  const auto fault = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
  if (fault != times.end()) {
    table.reject("t_s", "want growing times, got " + std::to_string(*fault) + " before " +
                            std::to_string(*(fault + 1)));
  }
  const std::size_t size = times.size();
  const std::vector<double> x = table.numbers("x_m", position_range, size);
  const std::vector<double> y = table.numbers("y_m", position_range, size);
  const std::vector<double> heading = table.numbers("heading_deg", heading_range, size);
  const std::vector<double> speed = table.numbers("speed_mps", speed_range, size);
  Recording recording(size);
  for (std::size_t k = 0; k < size; ++k) {
    recording[k] = {times[k], {{x[k], y[k]}, wrap_angle(from_degrees(heading[k]))}, speed[k]};
  }
  return recording;
}

Recording read_ego_recording(Table table) {
  Recording recording = read_recording(table);
  const std::vector<double> yaw_rate =
      table.numbers("yaw_rate_degps", yaw_rate_range, recording.size());
  for (std::size_t k = 0; k < recording.size(); ++k) {
    recording[k].yaw_rate = from_degrees(yaw_rate[k]);
  }
  return recording;
}

Script read_script(Table table, world::ActorKind kind) {
  Script script;
  script.start = read_lane_pose(table);
  script.speed = table.number("speed_mps", speed_range);
  script.behaviour =
      read_word(table, "behaviour", behaviour_from,
                "hold, constant_velocity, accelerate, brake, lane_change, follow, walk");
  if (kind == world::ActorKind::obstacle && script.behaviour != Behaviour::hold) {
    table.reject("behaviour",
                 "want hold for an obstacle, got \"" + std::string(name(script.behaviour)) + "\"");
  }
  switch (script.behaviour) {
    case Behaviour::hold:
      if (script.speed > 0.0) {
        table.reject("speed_mps", "want 0 for an actor that holds");
      }
      break;
    case Behaviour::constant_velocity:
      break;
    case Behaviour::accelerate:
      read_accelerate(script, table);
      break;
    case Behaviour::brake:
      script.acceleration = table.number("deceleration_mps2", deceleration_range);
      script.from = table.number("brake_at_s", time_range);
      break;
    case Behaviour::lane_change:
      read_lane_change(script, table);
      break;
    case Behaviour::follow:
      read_follow(script, table, kind);
      break;
    case Behaviour::walk:
      read_walk(script, table, kind);
      break;
  }
  return script;
}

}  // namespace saca::scenario

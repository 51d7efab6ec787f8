#include "saca/lab/importers/hundred_car_judge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/names.h"
#include "saca/lab/importers/hundred_car_words.h"

namespace saca::importers {
namespace {

constexpr std::array<std::string_view, 12> reason_names{"unreadable",
                                                        "other_conflict",
                                                        "leaves_lane",
                                                        "no_lead",
                                                        "no_follower",
                                                        "sensor_gap",
                                                        "impossible_values",
                                                        "no_lane_before",
                                                        "leaves_road",
                                                        "touches_in_near_crash",
                                                        "touches_nobody_in_crash",
                                                        "no_scenario"};

constexpr std::array<std::string_view, 12> meanings{
    "its rows or its line in the table of events cannot be read",
    "no rear-end conflict: the other is neither ahead nor behind",
    "the driver changes lanes, turns, parks or backs when it begins",
    "no radar target ahead for long enough",
    "struck from behind, and the rear radar saw nobody for long enough",
    "speed or yaw rate are missing for long",
    "a speed, yaw rate or range that no car has",
    "the motion before the conflict fits no lane",
    "as rebuilt the driver leaves the road",
    "as rebuilt the driver touches somebody in a near-crash",
    "as rebuilt the driver touches nobody in a crash",
    "what comes of it is no scenario that a file may hold"};

}  // namespace

std::string_view name(HundredCarReason reason) {
  return name_of(reason, reason_names);
}

std::string_view meaning(HundredCarReason reason) {
  return name_of(reason, meanings);
}

HundredCarRefusal refusal(const HundredCarRequest& request, HundredCarReason reason,
                          const std::string& message) {
  return {reason, "event " + std::to_string(request.event) + ": " + message};
}

std::optional<HundredCarRefusal> excluded(const recordings::HundredCarEvent& event,
                                          const HundredCarRequest& request) {
  if (!is_rear_end(event)) {
    return refusal(request, HundredCarReason::other_conflict,
                   "want a rear-end conflict, got `" + event.nature + "`");
  }
  if (leaves_lane(event)) {
    return refusal(
        request, HundredCarReason::leaves_lane,
        "want a driver who keeps a lane before the conflict, got `" + event.manoeuvre_before + "`");
  }
  return std::nullopt;
}

std::string impossible_value(const std::vector<recordings::HundredCarRow>& rows) {
  constexpr double fastest = 100.0;         // [m/s]
  constexpr double fastest_turning = 6.28;  // [rad/s]
  constexpr double farthest = 1000.0;       // [m]
  const auto said = [](const std::string& what, double most, double got) {
    return "want " + what + " up to " + shown(most, 2) + ", got " + shown(got, 2);
  };
  for (const recordings::HundredCarRow& row : rows) {
    if (row.speed > fastest) {
      return said("speeds in m/s", fastest, row.speed);
    }
    if (std::abs(row.yaw_rate) > fastest_turning) {
      return said("yaw rates in rad/s", fastest_turning, row.yaw_rate);
    }
    for (const auto& seen : {row.front, row.rear}) {
      for (const recordings::RadarTarget& target : seen) {
        if (target.range > farthest || std::abs(target.rate) > fastest) {
          return said("ranges in m and range rates in m/s", farthest,
                      std::max(target.range, std::abs(target.rate)));
        }
      }
    }
  }
  return "";
}

std::optional<Contradiction> contradiction(const scenario::Scenario& scenario,
                                           const recordings::HundredCarEvent& event,
                                           const HundredCarRequest& request) {
  const RecordedDrive drive = recorded_drive(scenario, scenario::standard_ego);
  if (drive.departure) {
    const bool left = drive.departure->side == collision::Side::left;
    return Contradiction{refusal(request, HundredCarReason::leaves_road,
                                 "want a driver who stays on the road, got one who is beyond its " +
                                     std::string(left ? "left" : "right") + " edge from " +
                                     shown(drive.departure->time, 1) + " s on, by up to " +
                                     shown(drive.departure->beyond, 2) + " m"),
                         drive.departure};
  }
  const bool crash = event.severity.starts_with("Crash");
  if (crash && !drive.touch) {
    return Contradiction{
        refusal(request, HundredCarReason::touches_nobody_in_crash,
                "want a driver who touches somebody in a crash, got nobody touched "
                "while the radar saw them"),
        std::nullopt};
  }
  if (!crash && drive.touch) {
    return Contradiction{refusal(request, HundredCarReason::touches_in_near_crash,
                                 "want a driver who touches nobody in a near-crash, got " +
                                     scenario::actor_name(scenario.actors[drive.touch->actor]) +
                                     " touched at " + shown(drive.touch->time, 1) + " s"),
                         std::nullopt};
  }
  return std::nullopt;
}

std::string scenario_problem(const scenario::Scenario& scenario) {
  const auto& ego = std::get<scenario::Recording>(scenario.ego);
  double way = 0.0;
  for (std::size_t k = 1; k < ego.size(); ++k) {
    way += norm(ego[k].X_WA.p - ego[k - 1].X_WA.p);
  }
  constexpr double far_seen = 200.0;   // [m]
  constexpr double most_turned = 3.0;  // [rad]: farther round, places on the arc are not unique
  if (std::abs(scenario.road.curvature) * (way + far_seen) > most_turned) {
    return "want a lane that turns by less than 170 deg within what is driven and seen, got one of "
           "curvature " +
           shown(scenario.road.curvature, 4) + " 1/m";
  }
  const Result<scenario::Scenario> again =
      scenario::read_scenario(scenario::write_scenario(scenario), scenario.name);
  return again.has_value() ? "" : again.error().message;
}

}  // namespace saca::importers

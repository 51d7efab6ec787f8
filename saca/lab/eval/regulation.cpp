#include "saca/lab/eval/regulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/base/core/units.h"

namespace saca::eval {
namespace {

using scenario::Behaviour;
using world::ActorKind;

constexpr std::array<std::string_view, 5> verdict_names{"passed", "contact", "no_braking",
                                                        "false_reaction", "fault"};

double front_of(const world::Footprint& ego) {
  return ego.centre_x + 0.5 * ego.length;
}

ActorKind kind_of(const TestTarget& target) {
  return target.name == "car"       ? ActorKind::car
         : target.name == "bicycle" ? ActorKind::bicycle
                                    : ActorKind::pedestrian;
}

scenario::ScenarioActor actor_of(const TestTarget& target, std::uint8_t id,
                                 const scenario::Script& script) {
  const ActorKind kind = kind_of(target);
  const auto shape = kind == ActorKind::pedestrian ? world::Shape::ellipse : world::Shape::box;
  return {.id = id,
          .kind = kind,
          .footprint = {.shape = shape, .length = target.length, .width = target.width},
          .mass = target.mass,
          .motion = script};
}

/// @param rear  its rearmost point along the road [m]
scenario::ScenarioActor lead_at(const Regulation& regulation, double rear, double speed) {
  return actor_of(regulation.car, 1,
                  {.start = {.s = rear + 0.5 * regulation.car.length},
                   .speed = speed,
                   .behaviour = speed > 0.0 ? Behaviour::constant_velocity : Behaviour::hold});
}

/// Where the middle of who crosses, stands or walks meets the ego's front: d of it [m].
double meeting_d(const RegulationRow& row, const world::Footprint& ego) {
  return (row.from_right ? 1.0 : -1.0) * (row.overlap - 0.5) * ego.width;
}

scenario::Script crossing_script(const RegulationRow& row, const world::Footprint& ego, double s) {
  const double side = row.from_right ? -1.0 : 1.0;
  scenario::Script script{.start = {.s = s, .d = 0.0, .heading = -side * 0.5 * std::numbers::pi}};
  if (row.start_offset) {
    script.start.d = side * *row.start_offset;
    script.behaviour = Behaviour::accelerate;
    script.acceleration = row.target_speed * row.target_speed / (2.0 * row.speed_within);
    script.until_speed = row.target_speed;
    script.from = row.time_to_collision - crossing_time(row, ego.width);
    expects(script.from >= 0.0, "who crosses is there in time");
  } else {
    script.start.d = meeting_d(row, ego) + side * row.target_speed * row.time_to_collision;
    script.speed = row.target_speed;
    script.behaviour = Behaviour::constant_velocity;
  }
  return script;
}

void add_parked(const Regulation& regulation, const RegulationRow& row, double contact_plane,
                const world::Footprint& ego, scenario::Scenario& scenario) {
  const TestTarget& car = regulation.car;
  const double side = row.from_right ? -1.0 : 1.0;
  const double d = side * (0.5 * ego.width + row.parked->beside_subject + 0.5 * car.width);
  double s = contact_plane - row.parked->before_target - 0.5 * car.length;
  for (const std::uint8_t id : {std::uint8_t{1}, std::uint8_t{2}}) {
    scenario.actors.push_back(
        actor_of(car, id, {.start = {.s = s, .d = d}, .behaviour = Behaviour::hold}));
    s -= car.length + row.parked->between;
  }
  scenario.perception.occlusion = true;
}

void add_person(const Regulation& regulation, const RegulationRow& row, double speed,
                const world::Footprint& ego, scenario::Scenario& scenario) {
  const double along = row.kind == TestKind::walking_along ? row.target_speed : 0.0;
  const double contact_plane = front_of(ego) + row.time_to_collision * (speed - along);
  if (row.kind == TestKind::crossing) {
    const double s = contact_plane + 0.5 * row.target.width;
    scenario.actors.push_back(actor_of(row.target, 1, crossing_script(row, ego, s)));
    if (row.parked) {
      add_parked(regulation, row, contact_plane, ego, scenario);
    }
    return;
  }
  scenario.actors.push_back(
      actor_of(row.target, 1,
               {.start = {.s = contact_plane + 0.5 * row.target.length, .d = meeting_d(row, ego)},
                .speed = along,
                .behaviour = along > 0.0 ? Behaviour::constant_velocity : Behaviour::hold}));
}

void add_parked_pair(const Regulation& regulation, const RegulationRow& row, double speed,
                     const world::Footprint& ego, scenario::Scenario& scenario) {
  const TestTarget& car = regulation.car;
  const double s = front_of(ego) + row.time_to_collision * speed + 0.5 * car.length;
  for (const double side : {-1.0, 1.0}) {
    scenario.actors.push_back(actor_of(car, static_cast<std::uint8_t>(scenario.actors.size() + 1),
                                       {.start = {.s = s, .d = side * 0.5 * (row.gap + car.width)},
                                        .behaviour = Behaviour::hold}));
  }
}

void bend(const Regulation& regulation, const RegulationRow& row, double speed,
          const world::Footprint& ego, scenario::Scenario& scenario) {
  world::Road& road = scenario.road;
  road.curvature = 1.0 / (row.outer_radius - 0.5 * regulation.lane_width);
  road.right_edge = -0.5 * regulation.lane_width;
  road.right_beyond = world::Beyond::barrier;
  road.left_edge = 1.5 * regulation.lane_width;
  const double ahead = front_of(ego) + row.time_to_collision * speed + 0.5 * row.target.length;
  scenario.actors.push_back(
      actor_of(row.target, 1,
               {.start = world::to_lane(road, {.p = {ahead, 0.0}, .yaw = 0.0}),
                .behaviour = Behaviour::hold}));
}

}  // namespace

double crossing_time(const RegulationRow& row, double ego_width) {
  const double way = *row.start_offset + (row.overlap - 0.5) * ego_width;
  return 2.0 * row.speed_within / row.target_speed + (way - row.speed_within) / row.target_speed;
}

std::string_view name(TestKind kind) {
  return name_of(kind, test_kind_names);
}
std::string_view name(LimitKind kind) {
  return name_of(kind, limit_kind_names);
}
std::string_view name(TestVerdict verdict) {
  return name_of(verdict, verdict_names);
}

std::vector<RegulationCell> cells_of(const Regulation& regulation) {
  std::vector<RegulationCell> cells;
  for (std::size_t r = 0; r < regulation.rows.size(); ++r) {
    const RegulationRow& row = regulation.rows[r];
    for (std::size_t i = 0; i < row.speeds.size(); ++i) {
      RegulationCell cell{
          .row = r, .speed = row.speeds[i], .headway = {}, .deceleration = {}, .impact_speed = {}};
      if (row.limit == LimitKind::impact_speed) {
        cell.impact_speed = row.impact_speeds[i];
      }
      if (row.kind != TestKind::braking_lead) {
        cells.push_back(cell);
        continue;
      }
      for (const double headway : row.headways) {
        for (const double deceleration : row.decelerations) {
          cell.headway = headway;
          cell.deceleration = deceleration;
          cells.push_back(cell);
        }
      }
    }
  }
  return cells;
}

std::string label_of(const RegulationCell& cell) {
  std::string label = fmt::format("{:.0f} km/h", to_kmh(cell.speed));
  if (cell.headway) {
    label += fmt::format(", {:.0f} m, {:.1f} g", *cell.headway, *cell.deceleration / from_g(1.0));
  }
  return label;
}

scenario::Scenario scenario_of(const Regulation& regulation, const RegulationCell& cell,
                               const world::Footprint& ego) {
  expects(cell.row < regulation.rows.size(), "a cell of this regulation");
  expects(regulation.surface < regulation.surfaces.size(), "a surface of this regulation");
  const RegulationRow& row = regulation.rows[cell.row];
  constexpr double aftermath = 8.0;  // [s]: in it whoever brakes from 100 km/h comes to rest
  scenario::Scenario scenario;
  scenario.name = regulation.name + "_" + row.name;
  scenario.title = row.title + ", " + label_of(cell);
  scenario.source = regulation.source + ", " + row.paragraph;
  scenario.grip = regulation.surfaces[regulation.surface].grip;
  scenario.duration = row.time_to_collision + aftermath;
  scenario.road.lane_width = regulation.lane_width;
  scenario.road.left_edge = regulation.free_width;
  scenario.road.right_edge = -regulation.free_width;
  scenario.ego = scenario::EgoStart{{}, cell.speed};
  const double front = front_of(ego);
  switch (row.kind) {
    case TestKind::stopped_lead:
    case TestKind::slower_lead:
      scenario.actors.push_back(
          lead_at(regulation, front + row.time_to_collision * (cell.speed - row.lead_speed),
                  row.lead_speed));
      break;
    case TestKind::braking_lead: {
      scenario::ScenarioActor lead = lead_at(regulation, front + cell.headway.value(), cell.speed);
      scenario::Script& script = std::get<scenario::Script>(lead.motion);
      script.behaviour = Behaviour::brake;
      script.acceleration = cell.deceleration.value();
      script.from = row.following;
      scenario.actors.push_back(std::move(lead));
      scenario.duration = row.following + cell.speed / *cell.deceleration + aftermath;
      break;
    }
    case TestKind::crossing:
    case TestKind::standing:
    case TestKind::walking_along:
      add_person(regulation, row, cell.speed, ego, scenario);
      break;
    case TestKind::pass_between:
      add_parked_pair(regulation, row, cell.speed, ego, scenario);
      break;
    case TestKind::curve:
      bend(regulation, row, cell.speed, ego, scenario);
      break;
    case TestKind::steel_plate:
      break;
  }
  return scenario;
}

CellResult judged(const Regulation& regulation, const RegulationCell& cell, const MethodRun& run) {
  expects(cell.row < regulation.rows.size(), "a cell of this regulation");
  const RegulationRow& row = regulation.rows[cell.row];
  constexpr double rest = 0.1;  // [m/s]: slower, the ego stands, and the test is over
  const bool ahead = row.kind == TestKind::stopped_lead || row.kind == TestKind::slower_lead ||
                     row.kind == TestKind::braking_lead;
  CellResult result{.peak_deceleration = run.peak_deceleration};
  const bool touched = run.met && *run.met != "edge" && run.ego_speed > rest;
  if (touched) {
    result.impact_speed = ahead ? run.impact_speed : run.ego_speed;
  }
  if (!run.fault.empty()) {
    result.verdict = TestVerdict::fault;
    return result;
  }
  const bool braked = run.peak_deceleration >= regulation.least_braking;
  switch (row.limit) {
    case LimitKind::no_contact:
    case LimitKind::impact_speed:
      result.verdict = touched && result.impact_speed > cell.impact_speed.value_or(0.0)
                           ? TestVerdict::contact
                       : braked || touched ? TestVerdict::passed
                                           : TestVerdict::no_braking;
      break;
    case LimitKind::deceleration:
      result.verdict = run.peak_deceleration < row.peak_deceleration ? TestVerdict::passed
                                                                     : TestVerdict::false_reaction;
      break;
    case LimitKind::no_intervention:
      result.verdict = run.intervened() ? TestVerdict::false_reaction : TestVerdict::passed;
      break;
  }
  return result;
}

}  // namespace saca::eval

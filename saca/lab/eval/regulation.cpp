#include "saca/lab/eval/regulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "saca/base/config/config.h"
#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/names.h"
#include "saca/base/core/units.h"

namespace saca::eval {
namespace {

using config::Table;
using scenario::Behaviour;
using world::ActorKind;

constexpr std::array<std::string_view, 9> test_kind_names{
    "stopped_lead",  "slower_lead", "braking_lead", "crossing", "standing",
    "walking_along", "steel_plate", "pass_between", "curve"};
constexpr std::array<std::string_view, 4> limit_kind_names{"no_contact", "impact_speed",
                                                           "deceleration", "no_intervention"};
constexpr std::array<std::string_view, 5> verdict_names{"passed", "contact", "no_braking",
                                                        "false_reaction", "fault"};
constexpr std::array<std::string_view, 4> target_names{"car", "adult", "child", "bicycle"};

/// No car on a road is wider [m]: ISO 612 vehicles have up to 2.55 m.
constexpr double widest = 2.55;

// --- reading

template <class Word>
Word word_of(Table& table, std::string_view key, std::span<const std::string_view> words) {
  const std::string got = table.text(key);
  const auto found = std::find(words.begin(), words.end(), got);
  if (found == words.end()) {
    std::string wanted;
    for (const std::string_view word : words) {
      wanted += (wanted.empty() ? "" : ", ") + std::string(word);
    }
    table.reject(key, fmt::format("want one of {}; got \"{}\"", wanted, got));
    return Word{};
  }
  return static_cast<Word>(found - words.begin());
}

double kmh_in(Table& table, std::string_view key, double least = 0.0) {
  return from_kmh(table.number(key, {least, 300.0}));
}

std::vector<double> list_in(Table& table, std::string_view key, config::Range range,
                            double (*to_si)(double),
                            std::optional<std::size_t> size = std::nullopt) {
  std::vector<double> values = table.numbers(key, range, size);
  if (values.empty()) {
    table.reject(key, "want at least one value, got none");
  }
  std::transform(values.begin(), values.end(), values.begin(), to_si);
  return values;
}

double as_it_is(double value) {
  return value;
}

TestTarget read_target(Table table) {
  TestTarget target;
  target.name =
      target_names[static_cast<std::size_t>(word_of<std::uint8_t>(table, "name", target_names))];
  target.length = table.number("length_m", {0.1, 10.0});
  target.width = table.number("width_m", {0.1, 3.0});
  target.mass = table.number("mass_kg", {1.0, 1e4});
  target.source = table.text("source");
  return target;
}

TestTarget target_in(Table& table, const std::vector<TestTarget>& targets) {
  const std::string wanted = table.text("target");
  for (const TestTarget& target : targets) {
    if (target.name == wanted) {
      return target;
    }
  }
  table.reject("target", fmt::format("want one of the [[targets]]; got \"{}\"", wanted));
  return {.name = "adult", .length = 0.5, .width = 0.5, .mass = 75.0, .source = {}};
}

/// Time that who crosses needs from its start to where it meets a car of some width [s].
double crossing_time(const RegulationRow& row, double ego_width) {
  const double way = *row.start_offset + (row.overlap - 0.5) * ego_width;
  return 2.0 * row.speed_within / row.target_speed + (way - row.speed_within) / row.target_speed;
}

void read_crossing(Table& table, RegulationRow& row) {
  row.target_speed = kmh_in(table, "target_speed_kmh", 0.1);
  row.start_offset = table.optional_number("start_offset_m", {2.0, 50.0});
  if (row.start_offset) {
    row.speed_within = table.number("speed_within_m", {0.01, 10.0});
    if (crossing_time(row, widest) > row.time_to_collision) {
      table.reject(
          "start_offset_m",
          fmt::format("want who crosses to be there within the {} s to collision, got {:.2f} s",
                      row.time_to_collision, crossing_time(row, widest)));
    }
  }
  if (auto parked = table.optional_table("parked")) {
    row.parked = ParkedCars{.between = parked->number("between_m", {0.0, 20.0}),
                            .before_target = parked->number("before_target_m", {0.0, 20.0}),
                            .beside_subject = parked->number("beside_subject_m", {0.0, 20.0})};
  }
}

/// Who crosses, stands or walks, and where it meets the ego.
void read_person(Table& table, RegulationRow& row, const std::vector<TestTarget>& targets) {
  constexpr std::array<std::string_view, 2> sides{"left", "right"};
  row.target = target_in(table, targets);
  row.from_right = word_of<std::uint8_t>(table, "from", sides) != 0;
  row.overlap = 0.01 * table.number("overlap_percent", {0.0, 100.0});
  if (row.kind == TestKind::crossing) {
    read_crossing(table, row);
  } else if (row.kind == TestKind::walking_along) {
    row.target_speed = kmh_in(table, "target_speed_kmh", 0.1);
  }
}

void read_kind(Table& table, RegulationRow& row, const std::vector<TestTarget>& targets) {
  if (row.kind == TestKind::braking_lead) {
    row.headways = list_in(table, "headways_m", {1.0, 200.0}, as_it_is);
    row.decelerations = list_in(table, "decelerations_g", {0.01, 1.0}, from_g);
    row.following = table.number("following_s", {0.0, 30.0});
    return;
  }
  row.time_to_collision = table.number("time_to_collision_s", {0.5, 30.0});
  switch (row.kind) {
    case TestKind::slower_lead:
      row.lead_speed = kmh_in(table, "lead_speed_kmh", 0.1);
      break;
    case TestKind::crossing:
    case TestKind::standing:
    case TestKind::walking_along:
      read_person(table, row, targets);
      break;
    case TestKind::pass_between:
      row.gap = table.number("gap_m", {widest, 20.0});
      break;
    case TestKind::curve:
      row.target = target_in(table, targets);
      row.outer_radius = table.number("outer_radius_m", {10.0, 1000.0});
      break;
    case TestKind::stopped_lead:
    case TestKind::braking_lead:
    case TestKind::steel_plate:
      break;
  }
}

RegulationRow read_row(Table table, const std::vector<TestTarget>& targets) {
  RegulationRow row;
  row.name = table.plain_name("name");
  row.title = table.text("title");
  row.kind = word_of<TestKind>(table, "kind", test_kind_names);
  row.paragraph = table.text("paragraph");
  if (row.paragraph.empty()) {
    table.reject("paragraph", "want the paragraph that asks for this, got nothing");
  }
  row.speeds = list_in(table, "speeds_kmh", {1.0, 200.0}, from_kmh);
  row.manual_braking = table.flag("manual_braking", false);
  read_kind(table, row, targets);
  const double slowest = *std::min_element(row.speeds.begin(), row.speeds.end());
  const double ahead =
      std::max(row.lead_speed, row.kind == TestKind::walking_along ? row.target_speed : 0.0);
  if (slowest <= ahead) {
    table.reject("speeds_kmh",
                 fmt::format("want more than the {:.1f} km/h of who is ahead, got {:.1f}",
                             to_kmh(ahead), to_kmh(slowest)));
  }
  row.limit = word_of<LimitKind>(table, "limit", limit_kind_names);
  if (row.limit == LimitKind::impact_speed) {
    row.impact_speeds =
        list_in(table, "impact_speeds_kmh", {0.0, 200.0}, from_kmh, row.speeds.size());
  } else if (row.limit == LimitKind::deceleration) {
    row.peak_deceleration = from_g(table.number("peak_deceleration_g", {0.001, 2.0}));
  }
  return row;
}

Regulation read_whole(Table root) {
  Regulation regulation;
  regulation.name = root.plain_name("name");
  regulation.title = root.text("title");
  regulation.source = root.text("source");
  for (Table table : root.tables("surfaces")) {
    regulation.surfaces.push_back({.name = table.plain_name("name"),
                                   .grip = table.number("grip", {0.05, 1.2}),
                                   .source = table.text("source")});
  }
  if (regulation.surfaces.empty()) {
    root.reject("surfaces", "want at least one, got none");
  }
  regulation.least_braking = from_g(root.number("least_braking_g", {0.0, 1.0}));
  regulation.least_braking_source = root.text("least_braking_source");
  regulation.free_width = root.number("free_width_m", {2.0, 50.0});
  regulation.lane_width = root.number("lane_width_m", {2.0, 8.0});
  std::vector<TestTarget> targets;
  for (const Table& table : root.tables("targets")) {
    targets.push_back(read_target(table));
  }
  const auto car = std::find_if(targets.begin(), targets.end(),
                                [](const TestTarget& one) { return one.name == "car"; });
  if (car == targets.end()) {
    root.reject("targets", "want one whose name is car, got none");
  } else {
    regulation.car = *car;
  }
  std::set<std::string> names;
  for (Table table : root.tables("rows")) {
    regulation.rows.push_back(read_row(table, targets));
    if (!names.insert(regulation.rows.back().name).second) {
      table.reject("name",
                   "want each row's name once, got \"" + regulation.rows.back().name + "\" again");
    }
  }
  if (regulation.rows.empty()) {
    root.reject("rows", "want at least one, got none");
  }
  for (Table note : root.tables("notes")) {
    regulation.notes.push_back(note.text("text"));
  }
  return regulation;
}

// --- encounters

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

std::string_view name(TestKind kind) {
  return name_of(kind, test_kind_names);
}
std::string_view name(LimitKind kind) {
  return name_of(kind, limit_kind_names);
}
std::string_view name(TestVerdict verdict) {
  return name_of(verdict, verdict_names);
}

Result<Regulation> read_regulation(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  root.want_schema("saca.regulation/1");
  Regulation regulation = read_whole(root);
  if (const auto problem = document.value().error()) {
    return *problem;
  }
  return regulation;
}

Result<Regulation> load_regulation(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return read_regulation(text.value(), path.string());
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

#include "saca/sim/scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "saca/config/config.h"
#include "saca/core/file.h"
#include "saca/core/names.h"
#include "saca/core/units.h"
#include "saca/sim/motion.h"

namespace saca::sim {
namespace {

using config::Range;
using config::Table;

constexpr std::array<std::string_view, 4> behaviour_names{"hold", "constant_velocity", "accelerate",
                                                          "brake"};

// What a scenario may say: wide enough for every road, narrow enough to catch a slip.
constexpr Range position_range{-1e5, 1e5};  // [m]
constexpr Range heading_range{-180.0, 180.0};
constexpr Range speed_range{0.0, 100.0};  // [m/s]
constexpr Range yaw_rate_range{-360.0, 360.0};
constexpr Range time_range{0.0, 600.0};  // [s]
constexpr std::size_t max_samples = 6001;

double angle(Table& table, std::string_view key) {
  return wrap_angle(from_degrees(table.number(key, heading_range)));
}

/// The value that stands under `key` as a word; the first one when the word is not known.
template <class Enum>
Enum word(Table& table, std::string_view key, std::optional<Enum> (*from)(std::string_view),
          std::string_view wanted) {
  const std::string got = table.text(key);
  const std::optional<Enum> value = from(got);
  if (!value) {
    table.reject(key, "want " + std::string(wanted) + ", got \"" + got + "\"");
  }
  return value.value_or(Enum{});
}

world::Road read_road(Table table) {
  world::Road road;
  road.topology = word(table, "topology", world::topology_from, "straight, intersection, one_way");
  road.X_WL.p.x = table.number("x_m", position_range);
  road.X_WL.p.y = table.number("y_m", position_range);
  road.X_WL.yaw = angle(table, "heading_deg");
  road.curvature = table.number("curvature_1pm", {-0.2, 0.2});
  road.lane_width = table.number("lane_width_m", {2.0, 8.0});
  road.left_edge = table.number("left_edge_m", {0.5, 100.0});
  road.right_edge = table.number("right_edge_m", {-100.0, -0.5});
  constexpr std::string_view grounds = "unmarked, kerb, barrier, trees";
  road.left_beyond = word(table, "left_beyond", world::beyond_from, grounds);
  road.right_beyond = word(table, "right_beyond", world::beyond_from, grounds);
  road.oncoming_left = table.flag("oncoming_left", false);
  road.oncoming_right = table.flag("oncoming_right", false);
  return road;
}

/// A pose along the road; a reader of messages finds s and d rather than x and y.
world::LanePose read_lane_pose(Table& table) {
  world::LanePose pose;
  pose.s = table.number("s_m", position_range);
  pose.d = table.number("d_m", position_range);
  pose.heading = angle(table, "heading_deg");
  return pose;
}

Recording read_recording(Table table, bool with_yaw_rate) {
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
  const std::vector<double> yaw_rate = with_yaw_rate
                                           ? table.numbers("yaw_rate_degps", yaw_rate_range, size)
                                           : std::vector<double>(size, 0.0);
  Recording recording(size);
  for (std::size_t k = 0; k < size; ++k) {
    recording[k] = {times[k],
                    {{x[k], y[k]}, wrap_angle(from_degrees(heading[k]))},
                    speed[k],
                    from_degrees(yaw_rate[k])};
  }
  return recording;
}

Script read_script(Table table) {
  Script script;
  script.start = read_lane_pose(table);
  script.speed = table.number("speed_mps", speed_range);
  script.behaviour =
      word(table, "behaviour", behaviour_from, "hold, constant_velocity, accelerate, brake");
  switch (script.behaviour) {
    case Behaviour::hold:
      if (script.speed > 0.0) {
        table.reject("speed_mps", "want 0 for an actor that holds");
      }
      break;
    case Behaviour::constant_velocity:
      break;
    case Behaviour::accelerate:
      script.acceleration = table.number("acceleration_mps2", {-15.0, 15.0});
      break;
    case Behaviour::brake:
      script.acceleration = table.number("deceleration_mps2", {0.01, 15.0});
      script.from = table.number("brake_at_s", time_range);
      break;
  }
  return script;
}

/// The one of two tables that says how a body moves.
bool is_recorded(Table& table) {
  const bool recorded = table.has("recording");
  if (recorded && table.has("start")) {
    table.reject("start", "want either a start or a recording, got both");
  }
  return recorded;
}

std::variant<EgoStart, Recording> read_ego(Table table) {
  if (is_recorded(table)) {
    Table inner = table.table("recording");
    Recording recording = read_recording(inner, true);
    if (recording.front().time != 0.0) {
      inner.reject("t_s", "want the ego's recording to begin at 0");
    }
    return recording;
  }
  Table start = table.table("start");
  const world::LanePose pose = read_lane_pose(start);
  constexpr double most_heading = 30.0;  // [deg]: the ego drives along its lane
  if (std::abs(pose.heading) > from_degrees(most_heading)) {
    start.reject("heading_deg", "want -30 to 30 against the lane, got " +
                                    std::to_string(to_degrees(pose.heading)));
  }
  return EgoStart{pose, start.number("speed_mps", speed_range)};
}

ScenarioActor read_actor(Table table) {
  ScenarioActor actor;
  actor.id = static_cast<std::uint8_t>(table.integer("id", 1, 99));
  actor.kind = word(table, "kind", world::actor_kind_from,
                    "car, van, truck, motorcycle, bicycle, pedestrian, obstacle");
  const std::string shape = table.text("shape");
  if (shape != "box" && shape != "ellipse") {
    table.reject("shape", "want box or ellipse, got \"" + shape + "\"");
  }
  actor.footprint.shape = shape == "ellipse" ? world::Shape::ellipse : world::Shape::box;
  actor.footprint.length = table.number("length_m", {0.1, 40.0});
  actor.footprint.width = table.number("width_m", {0.1, 20.0});
  actor.mass = table.number("mass_kg", {1.0, 1e6});
  if (is_recorded(table)) {
    actor.motion = read_recording(table.table("recording"), false);
  } else {
    actor.motion = read_script(table.table("start"));
  }
  return actor;
}

std::string shown_name(const ScenarioActor& actor) {
  return std::string(world::name(actor.kind)) + std::to_string(actor.id);
}

/// Whether an actor is there when the scenario begins.
bool present(const ScenarioActor& actor) {
  const auto* recording = std::get_if<Recording>(&actor.motion);
  return recording == nullptr || recording->front().time == 0.0;
}

/// On a curve d must stay on this side of its centre, or s means nothing.
void check_place(const world::Road& road, const world::LanePose& pose, Table table) {
  if (road.curvature * pose.d > 0.9) {
    table.reject("d_m", "want it nearer to the lane than the centre of its curve");
  }
}

/// Rules that join several bodies: names, and room between them at the start.
void check_bodies(const Scenario& scenario, std::vector<Table>& tables,
                  const world::Footprint& ego) {
  const Pose X_WB = ego_at(scenario, 0.0).X_WB;
  std::vector<Pose> starts;
  std::set<std::string> names;
  for (std::size_t i = 0; i < scenario.actors.size(); ++i) {
    const ScenarioActor& actor = scenario.actors[i];
    if (!names.insert(shown_name(actor)).second) {
      tables[i].reject("id", "want a new one, got a second " + shown_name(actor));
    }
    starts.push_back(actor_track(scenario, i, scenario.duration).X_WA.front());
    if (!present(actor)) {
      continue;
    }
    if (world::separation(ego, X_WB, actor.footprint, starts[i]).distance <= 0.0) {
      tables[i].reject("", shown_name(actor) + ": want room at the start, got it touching the ego");
    }
    for (std::size_t k = 0; k < i; ++k) {
      const ScenarioActor& other = scenario.actors[k];
      if (present(other) &&
          world::separation(actor.footprint, starts[i], other.footprint, starts[k]).distance <=
              0.0) {
        tables[i].reject("", shown_name(actor) + ": want room at the start, got it touching " +
                                 shown_name(other));
      }
    }
  }
}

void read_head(Table& root, Scenario& scenario) {
  const std::string schema = root.text("schema");
  if (schema != "saca.scenario/1") {
    root.reject("schema", "want \"saca.scenario/1\", got \"" + schema + "\"");
  }
  scenario.name = root.text("name");
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (scenario.name.empty() || scenario.name.find_first_not_of(letters) != std::string::npos) {
    root.reject("name", "want lower-case letters, digits and _, got \"" + scenario.name + "\"");
  }
  scenario.title = root.text("title");
  scenario.source = root.text("source");
  scenario.licence = root.text("licence");
  scenario.driver = root.optional_text("driver").value_or("");
  scenario.notes = root.optional_text("notes").value_or("");
  scenario.car = root.text("car");
  scenario.grip = root.number("grip", {0.05, 1.2});
  scenario.duration = root.number("duration_s", {0.1, 600.0});
}

std::optional<Provenance> read_provenance(Table& root) {
  std::optional<Table> table = root.optional_table("provenance");
  if (!table) {
    return std::nullopt;
  }
  Provenance provenance;
  constexpr std::int64_t most = 1'000'000'000;
  provenance.event = table->integer("event", 0, most);
  provenance.first_row = table->integer("first_row", 1, most);
  provenance.last_row = table->integer("last_row", provenance.first_row, most);
  return provenance;
}

}  // namespace

std::string_view name(Behaviour behaviour) {
  return name_of(behaviour, behaviour_names);
}
std::optional<Behaviour> behaviour_from(std::string_view name) {
  return value_from<Behaviour>(name, behaviour_names);
}

Result<Scenario> read_scenario(std::string_view text, std::string_view source,
                               const world::Footprint& ego) {
  const Result<config::Document> document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  Scenario scenario;
  read_head(root, scenario);
  scenario.provenance = read_provenance(root);
  scenario.road = read_road(root.table("road"));
  scenario.ego = read_ego(root.table("ego"));
  std::vector<Table> actors = root.tables("actors");
  if (actors.size() > world::max_actors) {
    root.reject("actors", "want at most " + std::to_string(world::max_actors) + ", got " +
                              std::to_string(actors.size()));
  }
  for (const Table& actor : actors) {
    scenario.actors.push_back(read_actor(actor));
  }
  if (const auto* start = std::get_if<EgoStart>(&scenario.ego)) {
    check_place(scenario.road, start->pose, root.table("ego"));
  }
  for (std::size_t i = 0; i < actors.size(); ++i) {
    if (const auto* script = std::get_if<Script>(&scenario.actors[i].motion)) {
      check_place(scenario.road, script->start, actors[i]);
    }
  }
  if (const std::optional<Error> error = document.value().error()) {
    return *error;
  }
  check_bodies(scenario, actors, ego);
  if (const std::optional<Error> error = document.value().error()) {
    return *error;
  }
  return scenario;
}

Result<Scenario> load_scenario(const std::filesystem::path& path, const world::Footprint& ego) {
  const Result<std::string> text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return read_scenario(text.value(), path.string(), ego);
}

}  // namespace saca::sim

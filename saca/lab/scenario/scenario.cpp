#include "saca/lab/scenario/scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/names.h"
#include "saca/base/core/units.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/scenario/motion_reader.h"

namespace saca::scenario {
namespace {

using config::Range;
using config::Table;

constexpr std::array<std::string_view, 7> behaviour_names{
    "hold", "constant_velocity", "accelerate", "brake", "lane_change", "follow", "walk"};
constexpr std::array<std::string_view, 3> deed_names{"stop", "go_on", "run"};

world::Road read_road(Table table) {
  world::Road road;
  road.topology =
      read_word(table, "topology", world::topology_from, "straight, intersection, one_way");
  road.X_WL.p.x = table.number("x_m", position_range);
  road.X_WL.p.y = table.number("y_m", position_range);
  road.X_WL.yaw = read_angle(table, "heading_deg");
  road.curvature = table.number("curvature_1pm", {-0.2, 0.2});
  road.lane_width = table.number("lane_width_m", {2.0, 8.0});
  road.left_edge = table.number("left_edge_m", {0.5, 100.0});
  road.right_edge = table.number("right_edge_m", {-100.0, -0.5});
  constexpr std::string_view grounds = "unmarked, kerb, barrier, trees";
  road.left_beyond = read_word(table, "left_beyond", world::beyond_from, grounds);
  road.right_beyond = read_word(table, "right_beyond", world::beyond_from, grounds);
  road.oncoming_left = table.flag("oncoming_left", false);
  road.oncoming_right = table.flag("oncoming_right", false);
  return road;
}

std::variant<EgoStart, Recording> read_ego(Table table) {
  if (is_recorded(table)) {
    Table inner = table.table("recording");
    Recording recording = read_ego_recording(inner);
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

world::Footprint read_footprint(Table& table, world::ActorKind kind) {
  world::Footprint footprint;
  footprint.shape = read_word(table, "shape", world::shape_from, "box, ellipse, segment");
  footprint.length = table.number("length_m", {0.1, 40.0});
  if (footprint.shape != world::Shape::segment) {
    footprint.width = table.number("width_m", {0.1, 20.0});
  } else if (table.has("width_m")) {
    table.reject("width_m", "want none: a segment has no width");
  } else if (kind != world::ActorKind::obstacle) {
    table.reject("shape", "want a segment for obstacles only, got a " + std::string(name(kind)));
  }
  return footprint;
}

/// What a body of this kind weighs [kg]: wide enough for anything of its kind, with who rides it,
/// and narrow enough to catch a number in tonnes.
Range masses_of(world::ActorKind kind) {
  switch (kind) {
    case world::ActorKind::car:
    case world::ActorKind::van:
      return {300.0, 10'000.0};
    case world::ActorKind::truck:
      return {1'000.0, 100'000.0};
    case world::ActorKind::motorcycle:
      return {40.0, 1'000.0};
    case world::ActorKind::bicycle:
      return {10.0, 500.0};
    case world::ActorKind::pedestrian:
      return {5.0, 500.0};
    case world::ActorKind::obstacle:
      break;
  }
  return {1.0, 1e6};
}

ScenarioActor read_actor(Table table) {
  ScenarioActor actor;
  actor.id = static_cast<std::uint8_t>(table.integer("id", 1, 99));
  actor.kind = read_word(table, "kind", world::actor_kind_from,
                         "car, van, truck, motorcycle, bicycle, pedestrian, obstacle");
  actor.footprint = read_footprint(table, actor.kind);
  actor.mass = table.number("mass_kg", masses_of(actor.kind));
  actor.ghost = table.flag("ghost", false);
  if (actor.ghost) {
    actor.existence = table.number("existence", {0.01, 0.99});
  } else if (table.has("existence")) {
    table.reject("existence", "want it of a ghost only: all others are there");
  }
  if (is_recorded(table)) {
    actor.motion = read_recording(table.table("recording"));
    return actor;
  }
  Table start = table.table("start");
  const Script script = read_script(start, actor.kind);
  if (actor.ghost && script.behaviour == Behaviour::follow) {
    start.reject("behaviour",
                 "want one that needs no driver: a ghost is not there, got \"follow\"");
  }
  actor.motion = script;
  return actor;
}

/// Everything that is not said is perfect.
PerceptionModel read_perception(Table& root) {
  PerceptionModel model;
  std::optional<Table> table = root.optional_table("perception");
  if (!table) {
    return model;
  }
  const auto optional = [&](std::string_view key, Range range, double& value) {
    value = table->optional_number(key, range).value_or(value);
  };
  optional("position_sd_m", {0.0, 100.0}, model.position_sd);
  optional("velocity_sd_mps", {0.0, 100.0}, model.velocity_sd);
  if (const auto sd = table->optional_number("heading_sd_deg", {0.0, 180.0})) {
    model.heading_sd = from_degrees(*sd);
  }
  optional("correlation_s", {0.0, 600.0}, model.correlation_time);
  optional("latency_s", {0.0, 2.0}, model.latency);
  optional("dropout", {0.0, 1.0}, model.dropout);
  optional("range_m", {0.1, 1e6}, model.range);
  model.occlusion = table->flag("occlusion", model.occlusion);
  optional("confirmation_s", {0.0, 600.0}, model.confirmation);
  optional("memory_s", {0.0, 600.0}, model.memory);
  model.grip_believed = table->optional_number("grip_believed", {0.05, 1.2});
  optional("grip_sd", {0.0, 1.2}, model.grip_sd);
  return model;
}

world::Cue read_cue(Table table) {
  return {.kind = read_word(table, "kind", world::cue_kind_from, world::cue_kind_words),
          .p_W = {table.number("x_m", position_range), table.number("y_m", position_range)}};
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
    if (!names.insert(actor_name(actor)).second) {
      tables[i].reject("id", "want a new one, got a second " + actor_name(actor));
    }
    starts.push_back(start_pose(scenario, i));
    if (!present(actor)) {
      continue;
    }
    if (world::separation(ego, X_WB, actor.footprint, starts[i]).distance <= 0.0) {
      tables[i].reject("", actor_name(actor) + ": want room at the start, got it touching the ego");
    }
    for (std::size_t k = 0; k < i; ++k) {
      const ScenarioActor& other = scenario.actors[k];
      if (present(other) && !actor.ghost && !other.ghost &&
          world::separation(actor.footprint, starts[i], other.footprint, starts[k]).distance <=
              0.0) {
        tables[i].reject("", actor_name(actor) + ": want room at the start, got it touching " +
                                 actor_name(other));
      }
    }
  }
}

void read_head(Table& root, Scenario& scenario) {
  root.want_schema("saca.scenario/1");
  scenario.name = root.plain_name("name");
  scenario.title = root.text("title");
  scenario.why = root.optional_text("why").value_or("");
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

double believed_grip(const Scenario& scenario) {
  return scenario.perception.grip_believed.value_or(scenario.grip);
}

std::string actor_name(const ScenarioActor& actor) {
  return world::actor_name(world::Actor{.id = actor.id, .kind = actor.kind});
}

std::string_view name(Behaviour behaviour) {
  return name_of(behaviour, behaviour_names);
}
std::optional<Behaviour> behaviour_from(std::string_view name) {
  return value_from<Behaviour>(name, behaviour_names);
}

std::string_view name(Deed deed) {
  return name_of(deed, deed_names);
}
std::optional<Deed> deed_from(std::string_view name) {
  return value_from<Deed>(name, deed_names);
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
  scenario.perception = read_perception(root);
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
  const std::vector<Table> cues = root.tables("cues");
  if (cues.size() > world::max_cues) {
    root.reject("cues", "want at most " + std::to_string(world::max_cues) + ", got " +
                            std::to_string(cues.size()));
  }
  std::transform(cues.begin(), cues.end(), std::back_inserter(scenario.cues), read_cue);
  if (const auto* start = std::get_if<EgoStart>(&scenario.ego)) {
    check_place(scenario.road, start->pose, root.table("ego"));
  }
  for (std::size_t i = 0; i < actors.size(); ++i) {
    if (const auto* script = std::get_if<Script>(&scenario.actors[i].motion)) {
      check_place(scenario.road, script->start, actors[i]);
      if (script->behaviour == Behaviour::lane_change) {
        check_place(scenario.road, {.d = script->to_d}, actors[i]);
      }
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

}  // namespace saca::scenario

#include "saca/thinking/memory/scene_json.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/formats/json_reader.h"

namespace saca::memory {
namespace {

using nlohmann::json;
using Reader = formats::JsonReader;
using world::Actor;
using world::EgoState;
using world::Footprint;
using world::Road;
using world::Scene;

constexpr std::string_view schema = "saca.scene/1";

json footprint_json(const Footprint& footprint) {
  return {{"shape", world::name(footprint.shape)},
          {"length_m", footprint.length},
          {"width_m", footprint.width},
          {"centre_x_m", footprint.centre_x}};
}

json ego_json(const Scene& scene) {
  const EgoState& ego = scene.ego;
  return {{"x_m", ego.X_WB.p.x},         {"y_m", ego.X_WB.p.y},
          {"heading_rad", ego.X_WB.yaw}, {"forward_mps", ego.v_B.x},
          {"leftward_mps", ego.v_B.y},   {"yaw_rate_radps", ego.yaw_rate},
          {"forward_mps2", ego.a_B.x},   {"leftward_mps2", ego.a_B.y},
          {"mass_kg", scene.ego_mass},   {"footprint", footprint_json(scene.ego_footprint)}};
}

/// What may be known of a vehicle's controls; the key is there only if it is.
struct Control {
  const char* key;
  std::optional<double> world::SharedControls::*value;
};
constexpr std::array<Control, 3> controls{{{"steering_rad", &world::SharedControls::steering},
                                           {"throttle", &world::SharedControls::throttle},
                                           {"brake", &world::SharedControls::brake}}};

json actor_json(const Actor& actor) {
  json node = {{"id", actor.id},
               {"kind", world::name(actor.kind)},
               {"footprint", footprint_json(actor.footprint)},
               {"mass_kg", actor.mass},
               {"x_m", actor.X_WA.p.x},
               {"y_m", actor.X_WA.p.y},
               {"heading_rad", actor.X_WA.yaw},
               {"vx_mps", actor.v_W.x},
               {"vy_mps", actor.v_W.y},
               {"ax_mps2", actor.a_W.x},
               {"ay_mps2", actor.a_W.y},
               {"yaw_rate_radps", actor.yaw_rate},
               {"position_sd_m", actor.position_sd},
               {"velocity_sd_mps", actor.velocity_sd},
               {"existence", actor.existence},
               {"age_s", actor.age},
               {"occluded", actor.occluded}};
  for (const Control& control : controls) {
    if (const auto& value = actor.shared.*control.value) {
      node[control.key] = *value;
    }
  }
  return node;
}

json road_json(const Road& road) {
  return {{"topology", world::name(road.topology)},
          {"x_m", road.X_WL.p.x},
          {"y_m", road.X_WL.p.y},
          {"heading_rad", road.X_WL.yaw},
          {"curvature_1pm", road.curvature},
          {"lane_width_m", road.lane_width},
          {"left_edge_m", road.left_edge},
          {"right_edge_m", road.right_edge},
          {"left_beyond", world::name(road.left_beyond)},
          {"right_beyond", world::name(road.right_beyond)},
          {"oncoming_left", road.oncoming_left},
          {"oncoming_right", road.oncoming_right}};
}

Pose read_pose(Reader& reader) {
  return {{reader.number("x_m"), reader.number("y_m")}, reader.number("heading_rad")};
}

Footprint read_footprint(Reader reader) {
  const Footprint footprint{
      .shape = reader.word("shape", world::shape_from, "box, ellipse or segment"),
      .length = reader.number("length_m"),
      .width = reader.number("width_m"),
      .centre_x = reader.number("centre_x_m")};
  reader.refuse_others();
  return footprint;
}

void read_ego(Reader reader, Scene& scene) {
  scene.ego.X_WB = read_pose(reader);
  scene.ego.v_B = {reader.number("forward_mps"), reader.number("leftward_mps")};
  scene.ego.yaw_rate = reader.number("yaw_rate_radps");
  scene.ego.a_B = {reader.number("forward_mps2"), reader.number("leftward_mps2")};
  scene.ego_mass = reader.number("mass_kg");
  scene.ego_footprint = read_footprint(reader.object("footprint"));
  reader.refuse_others();
}

Actor read_actor(Reader reader) {
  Actor actor;
  actor.id =
      static_cast<std::uint8_t>(reader.integer("id", std::numeric_limits<std::uint8_t>::max()));
  actor.kind = reader.word("kind", world::actor_kind_from,
                           "car, van, truck, motorcycle, bicycle, pedestrian or obstacle");
  actor.footprint = read_footprint(reader.object("footprint"));
  actor.mass = reader.number("mass_kg");
  actor.X_WA = read_pose(reader);
  actor.v_W = {reader.number("vx_mps"), reader.number("vy_mps")};
  actor.a_W = {reader.number("ax_mps2"), reader.number("ay_mps2")};
  actor.yaw_rate = reader.number("yaw_rate_radps");
  actor.position_sd = reader.number("position_sd_m");
  actor.velocity_sd = reader.number("velocity_sd_mps");
  actor.existence = reader.number("existence");
  actor.age = reader.number("age_s");
  actor.occluded = reader.flag("occluded");
  for (const Control& control : controls) {
    if (reader.has(control.key)) {
      actor.shared.*control.value = reader.number(control.key);
    }
  }
  reader.refuse_others();
  return actor;
}

Road read_road(Reader reader) {
  constexpr std::string_view beyonds = "unmarked, kerb, barrier or trees";
  Road road;
  road.topology =
      reader.word("topology", world::topology_from, "straight, intersection or one_way");
  road.X_WL = read_pose(reader);
  road.curvature = reader.number("curvature_1pm");
  road.lane_width = reader.number("lane_width_m");
  road.left_edge = reader.number("left_edge_m");
  road.right_edge = reader.number("right_edge_m");
  road.left_beyond = reader.word("left_beyond", world::beyond_from, beyonds);
  road.right_beyond = reader.word("right_beyond", world::beyond_from, beyonds);
  road.oncoming_left = reader.flag("oncoming_left");
  road.oncoming_right = reader.flag("oncoming_right");
  reader.refuse_others();
  return road;
}

/// The key is there only if there is one.
constexpr const char* cues_key = "cues";

world::Cue read_cue(Reader reader) {
  const world::Cue cue{.kind = reader.word("kind", world::cue_kind_from, world::cue_kind_words),
                       .p_W = {reader.number("x_m"), reader.number("y_m")}};
  reader.refuse_others();
  return cue;
}

void read_cues(Reader& reader, Scene& scene) {
  if (!reader.has(cues_key)) {
    return;
  }
  const json* cues = reader.list(cues_key, world::max_cues);
  for (std::size_t i = 0; cues != nullptr && i < cues->size(); ++i) {
    scene.cues.push_back(read_cue(reader.element(cues_key, *cues, i)));
  }
}

void read_actors(Reader& reader, Scene& scene) {
  const json* actors = reader.list("actors", world::max_actors);
  for (std::size_t i = 0; actors != nullptr && i < actors->size(); ++i) {
    scene.actors.push_back(read_actor(reader.element("actors", *actors, i)));
  }
}

}  // namespace

json cues_json(std::span<const world::Cue> cues) {
  json all = json::array();
  for (const world::Cue& cue : cues) {
    all.push_back({{"kind", world::name(cue.kind)}, {"x_m", cue.p_W.x}, {"y_m", cue.p_W.y}});
  }
  return all;
}

json to_json(const Scene& scene) {
  const auto rule = world::broken_rule(scene);
  expects(!rule, rule.value_or(""));
  json actors = json::array();
  for (const Actor& actor : scene.actors) {
    actors.push_back(actor_json(actor));
  }
  json node = {{"schema", schema},
               {"time_s", scene.time},
               {"grip", scene.grip},
               {"grip_sd", scene.grip_sd},
               {"ego", ego_json(scene)},
               {"actors", std::move(actors)},
               {"road", road_json(scene.road)}};
  if (!scene.cues.empty()) {
    node[cues_key] = cues_json({scene.cues.begin(), scene.cues.size()});
  }
  return node;
}

Result<Scene> scene_from_json(const json& document) {
  std::optional<Error> problem;
  Reader reader(document, "", problem, "scene");
  Scene scene;
  reader.schema(schema);
  scene.time = reader.number("time_s");
  scene.grip = reader.number("grip");
  scene.grip_sd = reader.number("grip_sd");
  read_ego(reader.object("ego"), scene);
  scene.road = read_road(reader.object("road"));
  read_actors(reader, scene);
  read_cues(reader, scene);
  reader.refuse_others();
  if (problem) {
    return *problem;
  }
  if (const auto rule = world::broken_rule(scene)) {
    return Error{Error::Code::malformed, "scene: want that " + std::string(*rule)};
  }
  return scene;
}

}  // namespace saca::memory

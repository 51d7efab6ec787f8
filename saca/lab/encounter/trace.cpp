#include "saca/lab/encounter/trace.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "saca/base/core/units.h"
#include "saca/base/formats/short_numbers.h"
#include "saca/lab/encounter/state_json.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::encounter {
namespace {

using nlohmann::json;

/// Seeds of what was left to chance, by name.
json seeds_json(const Setup& setup) {
  return setup.seed ? json{{"chance", *setup.seed}} : json::object();
}

json header_json(const Setup& setup, const Record& record) {
  const scenario::Scenario& scenario = *setup.scenario;
  const world::Footprint body = manoeuvre::footprint(*setup.car);
  return {
      {"type", "header"},
      {"schema", "saca.trace/1"},
      {"scenario", scenario.name},
      {"title", scenario.title},
      {"source", scenario.source},
      {"licence", scenario.licence},
      {"pace", name(setup.pace)},
      {"model", setup.model == nullptr ? "off" : setup.model->description()},
      {"seeds", seeds_json(setup)},
      {"car", scenario.car},
      {"grip", record.grip},
      {"road", road_json(scenario.road)},
      {"ego", {{"length_m", body.length}, {"width_m", body.width}, {"centre_x_m", body.centre_x}}},
      {"actors", actor_bodies_json(scenario)}};
}

json known_actor_json(const world::Actor& actor) {
  json out = actor_json(actor);
  out["position_sd_m"] = actor.position_sd;
  out["velocity_sd_mps"] = actor.velocity_sd;
  out["existence"] = actor.existence;
  out["age_s"] = actor.age;
  out["occluded"] = actor.occluded;
  return out;
}

template <class ActorJson>
json all_actors(const world::Scene& scene, ActorJson actor_json) {
  json actors = json::array();
  std::transform(scene.actors.begin(), scene.actors.end(), std::back_inserter(actors), actor_json);
  return actors;
}

json knowledge_json(const world::Scene& scene) {
  return {{"grip", scene.grip},
          {"grip_sd", scene.grip_sd},
          {"actors", all_actors(scene, known_actor_json)}};
}

json trace_frame_json(const Frame& frame) {
  json out{{"type", "frame"},
           {"t_s", frame.scene.time},
           {"phase", name(frame.phase)},
           {"ego", ego_json(frame.scene.ego, frame.steering)},
           {"actors", all_actors(frame.scene, actor_json)},
           {"conflict_s", frame.conflict ? json(*frame.conflict) : json(nullptr)}};
  const json known = knowledge_json(frame.perceived);
  if (known != knowledge_json(frame.scene)) {
    out["perceived"] = known;
  }
  return out;
}

json trace_event_json(const arbitration::Event& event) {
  return {{"type", "event"},
          {"t_s", event.time},
          {"plane", name(event.plane)},
          {"kind", name(event.kind)},
          {"text", event.text}};
}

std::string json_line(const json& object) {
  return formats::with_short_numbers(object).dump(-1, ' ', false, json::error_handler_t::replace) +
         '\n';
}

/// A body as a row sees it.
struct TracedBody {
  std::string id;
  std::string_view kind;
  Pose X_WB;
  const world::Footprint& footprint;
  double speed;
};

std::string csv_row(double time, const TracedBody& body, bool is_perceived) {
  const Vec2 centre_W = body.X_WB * Vec2{body.footprint.centre_x, 0.0};
  return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", short_number(time), body.id, body.kind,
                     short_number(centre_W.x), short_number(centre_W.y),
                     short_number(to_degrees(body.X_WB.yaw)), short_number(body.speed),
                     short_number(body.footprint.length), short_number(body.footprint.width),
                     is_perceived ? 1 : 0);
}

std::string actor_rows(const world::Scene& scene, bool is_perceived) {
  std::string rows;
  for (const world::Actor& actor : scene.actors) {
    rows +=
        csv_row(scene.time,
                {actor_name(actor), name(actor.kind), actor.X_WA, actor.footprint, norm(actor.v_W)},
                is_perceived);
  }
  return rows;
}

}  // namespace

std::string trace_jsonl(const Setup& setup, const Record& record) {
  std::string lines = json_line(header_json(setup, record));
  for (const Frame& frame : record.frames) {
    lines += json_line(trace_frame_json(frame));
  }
  for (const arbitration::Event& event : record.events) {
    lines += json_line(trace_event_json(event));
  }
  return lines;
}

std::string trace_csv(const Setup& setup, const Record& record) {
  const world::Footprint body = manoeuvre::footprint(*setup.car);
  std::string rows = "t_s,id,kind,x_m,y_m,heading_deg,speed_mps,length_m,width_m,perceived\n";
  for (const Frame& frame : record.frames) {
    const world::EgoState& ego = frame.scene.ego;
    const TracedBody traced{"ego", "ego", ego.X_WB, body, norm(ego.v_B)};
    rows += csv_row(frame.scene.time, traced, false);
    rows += actor_rows(frame.scene, false);
    const world::Scene& known = frame.perceived;
    if (actor_rows(known, false) != actor_rows(frame.scene, false)) {
      rows += csv_row(frame.scene.time, traced, true);
      rows += actor_rows(known, true);
    }
  }
  return rows;
}

}  // namespace saca::encounter

#include "saca/loop/danger_map.h"

#include <algorithm>
#include <cmath>

#include "saca/loop/encounter.h"
#include "saca/reach/risk.h"

namespace saca::loop {
namespace {

using world::Actor;
using world::Scene;

constexpr double shortest_interval = 0.25;  // [s]
constexpr int most_maps = 16;
constexpr double most_points = 1225.0;   // of one map: what a record can bear
constexpr double around_obstacle = 8.0;  // [m]: beyond it most evasions have room
constexpr double around_ego = 5.0;       // [m]
constexpr double crawl = 0.5;            // [m/s]: below it there is nothing left to evade by

const Actor* named(const Scene& scene, std::string_view name) {
  const auto found = std::find_if(scene.actors.begin(), scene.actors.end(),
                                  [&](const Actor& actor) { return actor_name(actor) == name; });
  return found == scene.actors.end() ? nullptr : &*found;
}

const decide::Preview* preview_that_counts(const Record& record) {
  if (record.previews.empty()) {
    return nullptr;
  }
  return record.decision && record.decision->preview
             ? &record.previews[static_cast<std::size_t>(*record.decision->preview)]
             : &record.previews.back();
}

/// By risk; where that is the same, by value.
std::optional<std::string> most_dangerous(const preview::Situation& situation) {
  const auto& actors = situation.scene_at_trigger.actors;
  std::size_t most = 0;
  for (std::size_t i = 1; i < actors.size(); ++i) {
    const reach::ObstacleRisk& a = situation.risks[i];
    const reach::ObstacleRisk& b = situation.risks[most];
    if (a.risk > b.risk || (a.risk == b.risk && a.value > b.value)) {
      most = i;
    }
  }
  return actors.empty() ? std::nullopt : std::optional(actor_name(actors[most]));
}

/// The frames from T2 on in which there is a map to be drawn.
std::vector<const Frame*> mapped_frames(const Record& record, std::string_view name,
                                        const reach::DangerModel& model) {
  std::vector<const Frame*> frames;
  for (const Frame& frame : record.frames) {
    const Actor* const actor = named(frame.scene, name);
    if (frame.phase != Phase::recorded && norm(frame.scene.ego.v_B) > crawl && actor != nullptr &&
        model.exact(reach::meeting_of(frame.scene, *actor))) {
      frames.push_back(&frame);
    }
  }
  return frames;
}

}  // namespace

std::optional<DangerMap> danger_map(const Scene& scene, const Actor& actor,
                                    const reach::DangerModel& model) {
  reach::Meeting meeting = reach::meeting_of(scene, actor);
  if (!model.exact(meeting)) {
    return std::nullopt;
  }
  const Pose X_WO = reach::obstacle_frame(actor);
  const Vec2 ego_O{meeting.state[0], meeting.state[1]};
  const Pose X_OM{{}, std::atan2(ego_O.y, ego_O.x)};
  const double margin = world::bounding_radius(meeting.obstacle) + around_obstacle;
  const double length = margin + std::max(margin, norm(ego_O) + around_ego);
  DangerMap map{.time = scene.time,
                .ego_speed = meeting.state[3],
                .ego_yaw = wrap_angle(meeting.state[2] + X_WO.yaw),
                .X_AM = inverse(actor.X_WA) * (X_WO * X_OM),
                .first_M = {-margin, -margin},
                .step = std::sqrt(length * 2.0 * margin / most_points)};
  map.columns = static_cast<int>(length / map.step) + 1;
  map.rows = static_cast<int>(2.0 * margin / map.step) + 1;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const Vec2 p_O = X_OM * map.point_M(column, row);
      meeting.state[0] = p_O.x;
      meeting.state[1] = p_O.y;
      map.values.push_back(model.exact(meeting));
    }
  }
  return map;
}

std::optional<DangerMaps> danger_maps(const Record& record, const reach::DangerModel& model) {
  const decide::Preview* const preview = preview_that_counts(record);
  const auto name = preview != nullptr ? most_dangerous(preview->situation) : std::nullopt;
  if (!name) {
    return std::nullopt;
  }
  const std::vector<const Frame*> frames = mapped_frames(record, *name, model);
  if (frames.empty()) {
    return std::nullopt;
  }
  const double first = frames.front()->scene.time;
  const double span = frames.back()->scene.time - first;
  DangerMaps maps{.actor = *name, .interval = std::max(shortest_interval, span / most_maps)};
  for (const Frame* const frame : frames) {
    constexpr double rounding = 1e-6;  // [s], of times that are summed up
    const bool is_due =
        maps.maps.empty() || frame->scene.time >= maps.maps.back().time + maps.interval - rounding;
    if (is_due && maps.maps.size() < most_maps) {
      maps.maps.push_back(*danger_map(frame->scene, *named(frame->scene, *name), model));
    }
  }
  return maps;
}

}  // namespace saca::loop

#include "saca/lab/encounter/danger_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "saca/base/core/angle.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/thinking/danger/risk.h"

namespace saca::encounter {
namespace {

using world::Actor;
using world::Scene;

constexpr double shortest_interval = 0.25;  // [s]
constexpr int most_maps = 16;
constexpr double most_points = 1225.0;  // of one map: what a record can bear
constexpr double around = 8.0;          // [m], both bodies: beyond it there is room to spare
constexpr double to_swerve = 1.0;       // [s]: 0.5 g lead 2.5 m aside meanwhile
constexpr double crawl = 0.5;           // [m/s]: below it there is nothing left to evade by

const Actor* named(const Scene& scene, std::string_view name) {
  const auto found = std::find_if(scene.actors.begin(), scene.actors.end(),
                                  [&](const Actor& actor) { return actor_name(actor) == name; });
  return found == scene.actors.end() ? nullptr : &*found;
}

const arbitration::Preview* preview_that_counts(const Record& record) {
  if (record.previews.empty()) {
    return nullptr;
  }
  const arbitration::Preview* const matched =
      record.decision && record.decision->preview
          ? arbitration::find_preview(record.previews, *record.decision->preview)
          : nullptr;
  return matched == nullptr ? &record.previews.back() : matched;
}

/// By risk; where that is the same, by value. nullopt: nobody is judged.
std::optional<std::string> most_dangerous(const preview::Situation& situation) {
  const auto& actors = situation.scene_at_trigger.actors;
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < actors.size(); ++i) {
    const danger::ObstacleRisk& a = situation.risks[i];
    const auto key = [](const danger::ObstacleRisk& risk) {
      return std::pair(risk.risk, risk.value);
    };
    if (a.judged && (!most || key(a) > key(situation.risks[*most]))) {
      most = i;
    }
  }
  return most ? std::optional(actor_name(actors[*most])) : std::nullopt;
}

/// Names of the actors to be mapped, the first that can be.
std::vector<std::string> candidates(const Record& record) {
  std::vector<std::string> names;
  if (record.threat) {
    names.push_back(*record.threat);
  }
  const arbitration::Preview* const preview = preview_that_counts(record);
  if (const auto most = preview != nullptr ? most_dangerous(preview->situation) : std::nullopt) {
    names.push_back(*most);
  }
  return names;
}

/// Object minus ego.
Vec2 relative_velocity(const danger::Meeting& meeting) {
  const double course = meeting.state[2];
  return Vec2{meeting.obstacle_speed, 0.0} -
         meeting.state[3] * Vec2{std::cos(course), std::sin(course)};
}

/// M in the obstacle's frame: the ego comes from where its x points.
Pose map_frame(const danger::Meeting& meeting) {
  const Vec2 v_rel_O = relative_velocity(meeting);
  const Vec2 from_O = norm(v_rel_O) > crawl ? v_rel_O : Vec2{meeting.state[0], meeting.state[1]};
  return {{}, std::atan2(from_O.y, from_O.x)};
}

/// Two corners of the map, in M: around the obstacle, from where it is too late to swerve, and
/// around the ego.
std::array<Vec2, 2> corners(const danger::Meeting& meeting, Vec2 ego_M) {
  const double closing = norm(relative_velocity(meeting));
  const double margin = world::bounding_radius(meeting.obstacle) + around;
  return {Vec2{std::min(-margin, ego_M.x - around), std::min(-margin, ego_M.y - around)},
          Vec2{std::max(margin + to_swerve * closing, ego_M.x + around),
               std::max(margin, ego_M.y + around)}};
}

/// The frames from T2 on in which there is a map to be drawn.
std::vector<const Frame*> mapped_frames(const Record& record, std::string_view name,
                                        const danger::DangerModel& model) {
  std::vector<const Frame*> frames;
  for (const Frame& frame : record.frames) {
    const Actor* const actor = named(frame.scene, name);
    if (frame.phase != Phase::recorded && norm(frame.scene.ego.v_B) > crawl && actor != nullptr &&
        model.known(danger::meeting_of(frame.scene, *actor))) {
      frames.push_back(&frame);
    }
  }
  return frames;
}

/// @param frames  of which there are some, with maps
DangerMaps maps_of(const std::vector<const Frame*>& frames, const std::string& name,
                   const danger::DangerModel& model) {
  const double span = frames.back()->scene.time - frames.front()->scene.time;
  DangerMaps maps{.actor = name, .interval = std::max(shortest_interval, span / most_maps)};
  for (const Frame* const frame : frames) {
    constexpr double rounding = 1e-6;  // [s], of times that are summed up
    const bool is_due =
        maps.maps.empty() || frame->scene.time >= maps.maps.back().time + maps.interval - rounding;
    if (is_due && maps.maps.size() < most_maps) {
      maps.maps.push_back(danger_map(frame->scene, *named(frame->scene, name), model).value());
    }
  }
  return maps;
}

}  // namespace

std::optional<DangerMap> danger_map(const Scene& scene, const Actor& actor,
                                    const danger::DangerModel& model) {
  danger::Meeting meeting = danger::meeting_of(scene, actor);
  if (!model.known(meeting)) {
    return std::nullopt;
  }
  const Pose X_WO = danger::obstacle_frame(actor);
  const Pose X_OM = map_frame(meeting);
  const auto [low, high] =
      corners(meeting, inverse(X_OM) * Vec2{meeting.state[0], meeting.state[1]});
  const Vec2 size = high - low;
  DangerMap map{.time = scene.time,
                .ego_speed = meeting.state[3],
                .ego_yaw = wrap_angle(meeting.state[2] + X_WO.yaw),
                .X_AM = inverse(actor.X_WA) * (X_WO * X_OM),
                .first_M = low,
                .step = std::sqrt(size.x * size.y / most_points)};
  map.columns = static_cast<int>(size.x / map.step) + 1;
  map.rows = static_cast<int>(size.y / map.step) + 1;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const Vec2 p_O = X_OM * map.point(column, row);
      meeting.state[0] = p_O.x;
      meeting.state[1] = p_O.y;
      map.values.push_back(model.known(meeting));
    }
  }
  return map;
}

std::optional<DangerMaps> danger_maps(const Record& record, const danger::DangerModel& model) {
  for (const std::string& name : candidates(record)) {
    const std::vector<const Frame*> frames = mapped_frames(record, name, model);
    if (!frames.empty()) {
      return maps_of(frames, name, model);
    }
  }
  return std::nullopt;
}

}  // namespace saca::encounter

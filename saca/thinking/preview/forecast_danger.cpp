#include "saca/thinking/preview/forecast_danger.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/thinking/danger/intrusion.h"
#include "saca/thinking/danger/risk.h"
#include "saca/thinking/preview/moved_along.h"

namespace saca::preview {
namespace {

using manoeuvre::EgoMotion;
using world::Actor;
using world::Scene;
using world::Track;

/// The ego as it moves at a pose of its way; its acceleration is that of the steps before.
world::EgoState ego_at(const EgoMotion& way, std::size_t k) {
  constexpr std::size_t over = 5;  // poses
  world::EgoState ego{
      .X_WB = way.track.X_WA[k], .v_B = way.v_B[k], .yaw_rate = way.yaw_rate[k], .a_B = {}};
  if (k >= over) {
    const Vec2 before_W = rotated(way.v_B[k - over], way.track.X_WA[k - over].yaw);
    const Vec2 now_W = rotated(way.v_B[k], ego.X_WB.yaw);
    const double time = static_cast<double>(over) * way.track.step;
    ego.a_B = rotated((1.0 / time) * (now_W - before_W), -ego.X_WB.yaw);
  }
  return ego;
}

/// Whether anybody is met on the way, and how deep: the highest h.
double highest_h(const Scene& scene, const EgoMotion& way, const Actor& actor, const Track& track) {
  constexpr std::size_t every = 2;  // poses between two looks
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < way.track.X_WA.size(); k += every) {
    const double time = way.track.start + way.track.step * static_cast<double>(k);
    highest = std::max(highest, danger::intrusion(scene.ego_footprint, way.track.X_WA[k],
                                                  actor.footprint, world::pose_at(track, time)));
  }
  return highest;
}

/// Value of the third most dangerous; of the last where there are fewer.
double third_highest(const std::vector<danger::ObstacleRisk>& risks) {
  constexpr std::size_t most = 3;
  std::vector<double> values;
  for (const danger::ObstacleRisk& risk : risks) {
    if (risk.judged) {
      values.push_back(risk.value);
    }
  }
  std::sort(values.begin(), values.end(), std::greater<>());
  return values.empty() ? 0.0 : values[std::min(values.size(), most) - 1];
}

}  // namespace

std::optional<double> plan_danger(const Scene& scene, const std::vector<Track>& tracks,
                                  const manoeuvre::Plan& plan, const manoeuvre::Car& car,
                                  const DangerOfScene& value) {
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  if (std::all_of(scene.actors.begin(), scene.actors.end(),
                  [&](const Actor& actor) { return world::is_behind(scene, actor); })) {
    return std::nullopt;  // nobody for whom the plan would have to be driven
  }
  const EgoMotion way = manoeuvre::drive(car, plan, scene, scene.grip, committed);
  Scene then = scene;
  then.ego = ego_at(way, way.track.X_WA.size() - 1);
  then.time = world::end_time(way.track);
  then.actors.clear();
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    if (!world::is_behind(scene, scene.actors[i])) {
      highest = std::max(highest, highest_h(scene, way, scene.actors[i], tracks[i]));
      then.actors.push_back(moved_along(scene.actors[i], tracks[i], then.time));
    }
  }
  return std::max(highest, value(then));
}

PolicyDangers policy_dangers(const Scene& scene, const std::vector<Track>& tracks,
                             const std::vector<danger::ObstacleRisk>& risks, const AllFacts& facts,
                             const ForecastTools& tools) {
  expects(tools.car != nullptr && tools.danger != nullptr, "car and danger are given");
  expects(tracks.size() == scene.actors.size() && risks.size() == scene.actors.size(),
          "one track and one risk per actor");
  const double least = third_highest(risks);
  const auto is_watched = [&](const Actor& actor) {
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      if (scene.actors[i].kind == actor.kind && scene.actors[i].id == actor.id) {
        return risks[i].value >= least;
      }
    }
    return false;
  };
  const DangerOfScene value = [&](const Scene& then) {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Actor& actor : then.actors) {
      if (is_watched(actor)) {
        const auto danger =
            tools.danger->danger(danger::meeting_of(then, actor), danger::motion_of(then, actor));
        highest = std::max(highest, danger.value);
      }
    }
    return highest;
  };
  PolicyDangers dangers;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (facts[i].drivable()) {
      dangers[i] = plan_danger(scene, tracks, facts[i].plan, *tools.car, value);
    }
  }
  return dangers;
}

}  // namespace saca::preview

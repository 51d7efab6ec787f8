#include "saca/preview/followers.h"

#include <algorithm>
#include <utility>

#include "saca/core/contract.h"
#include "saca/intent/driver.h"
#include "saca/world/time_to_conflict.h"

namespace saca::preview {
namespace {

using world::Actor;
using world::Scene;
using world::Track;

constexpr double step = 0.02;          // [s]
constexpr double watched_after = 3.0;  // [s] beyond the ego's motion: any reaction and a firm stop

/// Indices of the followers, the nearest to the ego first: each reacts to those before it.
std::vector<std::size_t> followers_of(const Scene& scene) {
  std::vector<std::pair<double, std::size_t>> behind;
  const double ego_s = world::to_lane(scene.road, scene.ego.X_WB).s;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    if (world::is_follower(scene, scene.actors[i])) {
      behind.emplace_back(ego_s - world::to_lane(scene.road, scene.actors[i].X_WA).s, i);
    }
  }
  std::sort(behind.begin(), behind.end());
  std::vector<std::size_t> indices;
  std::transform(behind.begin(), behind.end(), std::back_inserter(indices),
                 [](const auto& one) { return one.second; });
  return indices;
}

Track reacting(const Scene& scene, std::size_t follower, const Track& X_WB,
               const std::vector<Track>& tracks) {
  const Actor& actor = scene.actors[follower];
  std::vector<intent::Body> others{{&scene.ego_footprint, &X_WB}};
  std::vector<intent::Present> now{intent::present(scene.road, scene.ego_footprint, scene.ego.X_WB,
                                                   rotated(scene.ego.v_B, scene.ego.X_WB.yaw))};
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (i != follower) {
      const Actor& other = scene.actors[i];
      others.push_back({&other.footprint, &tracks[i]});
      now.push_back(intent::present(scene.road, other.footprint, other.X_WA, other.v_W));
    }
  }
  const double speed = norm(actor.v_W);
  const intent::DriverLaw usual = intent::usual_driver(speed);
  const intent::LaneDriver here(scene.road, actor.footprint, actor.X_WA,
                                intent::Driver(usual, speed, scene.grip, step));
  const double end =
      std::max(world::end_time(tracks[follower]), world::end_time(X_WB) + watched_after);
  return reacting_track(scene.road, actor, content_with(usual, speed, here.ahead(now).gap), others,
                        scene.time, std::max(0.0, end - scene.time), step, scene.grip);
}

}  // namespace

outcome::Others with_reacting_followers(const Scene& scene, std::vector<Track> tracks) {
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  return [scene, followers = followers_of(scene),
          planned = std::move(tracks)](const manoeuvre::EgoMotion& ego) {
    std::vector<Track> moved = planned;
    for (const std::size_t follower : followers) {
      moved[follower] = reacting(scene, follower, ego.track, moved);
    }
    return moved;
  };
}

}  // namespace saca::preview

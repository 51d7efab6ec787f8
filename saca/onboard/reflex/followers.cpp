#include "saca/onboard/reflex/followers.h"

#include <algorithm>
#include <array>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"

namespace saca::reflex {
namespace {

using world::Actor;
using world::Scene;
using world::Track;

constexpr double usual_step = 0.02;  // [s]

drivers::ReactionSpan span_until(const Scene& scene, double until, double step) {
  return {scene.time, std::max(0.0, until - scene.time), step, scene.grip};
}

/// @param seen  whom it looks at beside the ego
void let_one_react(const Scene& scene, std::size_t follower, const Followers& seen,
                   const Track& X_WB, const drivers::ReactionSpan& span, std::span<Track> tracks) {
  const Actor& actor = scene.actors[follower];
  StaticVector<drivers::Body, world::max_actors> others;
  std::array<drivers::Present, world::max_actors> now;
  others.push_back({&scene.ego_footprint, &X_WB});
  now[0] = drivers::present(scene.road, scene.ego_footprint, scene.ego.X_WB,
                            rotated(scene.ego.v_B, scene.ego.X_WB.yaw));
  for (const std::size_t i : seen) {
    const Actor& other = scene.actors[i];
    now[others.size()] = drivers::present(scene.road, other.footprint, other.X_WA, other.v_W);
    others.push_back({&other.footprint, &tracks[i]});
  }
  const drivers::DriverLaw law =
      content_follower(scene, actor, {now.data(), others.size()}, span.step);
  reacting_track(scene.road, actor, law, {others.begin(), others.end()}, span, tracks[follower]);
}

}  // namespace

Followers followers_of(const Scene& scene) {
  const double ego_s = world::to_lane(scene.road, scene.ego.X_WB).s;
  const auto behind = [&](std::size_t i) {
    return ego_s - world::to_lane(scene.road, scene.actors[i].X_WA).s;
  };
  Followers followers;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    if (world::is_follower(scene, scene.actors[i])) {
      followers.push_back(i);
    }
  }
  std::sort(followers.begin(), followers.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(behind(a), a) < std::pair(behind(b), b);
  });
  return followers;
}

drivers::DriverLaw content_follower(const Scene& scene, const Actor& actor,
                                    std::span<const drivers::Present> seen, double step) {
  const double speed = norm(actor.v_W);
  const drivers::DriverLaw usual = drivers::usual_driver(speed);
  const drivers::LaneDriver here(scene.road, actor.footprint, actor.X_WA,
                                 drivers::Driver(usual, speed, scene.grip, step));
  return content_with(usual, speed, here.ahead(seen).gap);
}

void let_react(const Scene& scene, const Followers& followers, const Track& X_WB, double until,
               double step, std::span<Track> tracks) {
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  const drivers::ReactionSpan span = span_until(scene, until, step);
  Followers before;
  for (const std::size_t follower : followers) {
    let_one_react(scene, follower, before, X_WB, span, tracks);
    before.push_back(follower);
  }
}

Scene with_kept_gaps(Scene scene, const Followers& followers) {
  for (const std::size_t follower : followers) {
    scene.actors[follower].velocity_sd = 0.0;
  }
  return scene;
}

collision::Others with_reacting_followers(const Scene& scene, std::vector<Track> tracks) {
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  return [scene, followers = followers_of(scene),
          planned = std::move(tracks)](const manoeuvre::EgoMotion& ego) {
    std::vector<Track> moved = planned;
    for (const std::size_t follower : followers) {
      const double until =
          std::max(world::end_time(moved[follower]), world::end_time(ego.track) + watched_after);
      Followers others;
      for (std::size_t i = 0; i < moved.size(); ++i) {
        if (i != follower) {
          others.push_back(i);
        }
      }
      let_one_react(scene, follower, others, ego.track, span_until(scene, until, usual_step),
                    moved);
    }
    return moved;
  };
}

}  // namespace saca::reflex

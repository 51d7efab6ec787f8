#include "saca/onboard/reflex/followers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/drivers/driver.h"
#include "tests/support/scenes.h"

namespace saca::reflex::followers_test {
namespace {

using test::block;
using test::ego_at;
using test::whole_metres;
using world::Actor;
using world::Scene;
using world::Track;

constexpr double step = 0.01;

Track going_on(const Actor& actor) {
  Track track{.step = step, .X_WA = {}};
  for (int k = 0; k <= 800; ++k) {
    track.X_WA.push_back({actor.X_WA.p + step * k * actor.v_W, 0.0});
  }
  return track;
}

std::vector<Track> all_going_on(const Scene& scene) {
  std::vector<Track> tracks;
  for (const Actor& actor : scene.actors) {
    tracks.push_back(going_on(actor));
  }
  return tracks;
}

/// Only where it is matters to a forecast.
manoeuvre::EgoMotion along(Track X_WB) {
  return {.track = std::move(X_WB), .v_B = {}, .yaw_rate = {}};
}

/// The ego brakes at once, as hard as that.
Track braking(double speed, double deceleration) {
  Track track{.step = step, .X_WA = {}};
  for (int k = 0; k <= 800; ++k) {
    const double t = std::min(k * step, speed / deceleration);
    track.X_WA.push_back({{speed * t - 0.5 * deceleration * t * t, 0.0}, 0.0});
  }
  return track;
}

// 4 m behind at 20 m/s is within any reaction time: braking with 8 m/s^2 closes it after
// sqrt(2 * 4 / 8) = 1 s. Braking as hard from 35 m behind, 20 m/s * 1.25 s of it are used up.
TEST(WithReactingFollowers, AShortGapIsRunIntoALongOneIsNot) {
  for (const double gap : {4.0, 35.0}) {
    Scene scene = ego_at(20.0, whole_metres);
    scene.actors.push_back(block(1, {-4.0 - gap, 0.0}, {20.0, 0.0}));
    const Track X_WB = braking(20.0, 8.0);
    const auto tracks = with_reacting_followers(scene, all_going_on(scene))(along(X_WB));
    double least = gap;
    for (double time = 0.0; time < 8.0; time += step) {
      least = std::min(least, pose_at(X_WB, time).p.x - world::pose_at(tracks[0], time).p.x - 4.0);
    }
    EXPECT_EQ(least < 0.0, gap < 10.0) << gap;
    if (gap < 10.0) {
      EXPECT_NEAR(world::pose_at(tracks[0], 1.0).p.x + 4.0, pose_at(X_WB, 1.0).p.x, 0.05);
    } else {
      EXPECT_LT(norm(world::velocity_at(tracks[0], 7.0)), 0.5);
    }
  }
}

// Who goes on gives nobody a reason to brake, however short the gap.
TEST(WithReactingFollowers, AContentFollowerGoesOnBehindAnEgoThatGoesOn) {
  Scene scene = ego_at(20.0, whole_metres);
  scene.actors.push_back(block(1, {-10.0, 0.0}, {20.0, 0.0}));
  const Track X_WB = going_on(block(2, {}, {20.0, 0.0}));
  const auto tracks = with_reacting_followers(scene, all_going_on(scene))(along(X_WB));
  EXPECT_NEAR(world::pose_at(tracks[0], 8.0).p.x, -10.0 + 160.0, 0.1);
}

// A car beside the ego is no follower, nor is one ahead: they keep to their tracks.
TEST(WithReactingFollowers, EveryoneElseKeepsToItsTrack) {
  Scene scene = ego_at(10.0, whole_metres);
  scene.actors.push_back(block(1, {-1.0, 3.5}, {10.0, 0.0}));
  scene.actors.push_back(block(2, {-9.0, 3.5}, {15.0, 0.0}));
  scene.actors.push_back(block(3, {30.0, 0.0}, {5.0, 0.0}));
  const auto tracks =
      with_reacting_followers(scene, all_going_on(scene))(along(braking(10.0, 8.0)));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(world::pose_at(tracks[i], 4.0).p.x, pose_at(going_on(scene.actors[i]), 4.0).p.x);
  }
}

// The second follower is listed first; it sees the first one brake, not the ego.
TEST(WithReactingFollowers, FollowersReactInARow) {
  Scene scene = ego_at(20.0, whole_metres);
  scene.actors.push_back(block(1, {-80.0, 0.0}, {20.0, 0.0}));
  scene.actors.push_back(block(2, {-40.0, 0.0}, {20.0, 0.0}));
  const auto tracks =
      with_reacting_followers(scene, all_going_on(scene))(along(braking(20.0, 6.0)));
  for (double time = 0.0; time < 8.0; time += 0.1) {
    EXPECT_LT(world::pose_at(tracks[0], time).p.x + 4.0, pose_at(tracks[1], time).p.x) << time;
  }
  EXPECT_LT(norm(world::velocity_at(tracks[0], 7.9)), 3.0);
}

TEST(WithReactingFollowers, WantsOneTrackPerActor) {
  Scene scene = ego_at(10.0, whole_metres);
  scene.actors.push_back(block(1, {-14.0, 0.0}, {10.0, 0.0}));
  EXPECT_THROW((void)with_reacting_followers(scene, {}), ContractViolation);
}

// The finer forecast is the reference: steps three times as long move a follower by decimetres.
TEST(LetReact, IsTheSameWhereNobodyElseIsInTheWay) {
  Scene scene = ego_at(20.0, whole_metres);
  scene.actors.push_back(block(1, {-75.0, 0.0}, {20.0, 0.0}));
  scene.actors.push_back(block(2, {60.0, 3.5}, {5.0, 0.0}));
  scene.actors.push_back(block(3, {-35.0, 0.0}, {20.0, 0.0}));
  const Track X_WB = braking(20.0, 6.0);
  const auto reference = with_reacting_followers(scene, all_going_on(scene))(along(X_WB));
  const Followers followers = followers_of(scene);
  ASSERT_EQ(followers.size(), 2U);
  EXPECT_EQ(followers[0], 2U);  // the nearest first
  EXPECT_EQ(followers[1], 0U);
  std::vector<Track> tracks = all_going_on(scene);
  let_react(scene, followers, X_WB, 8.0, 1.0 / 16, tracks);
  for (std::size_t i = 0; i < 3; ++i) {
    for (double time = 0.0; time <= 8.0; time += 0.5) {
      EXPECT_NEAR(pose_at(tracks[i], time).p.x, world::pose_at(reference[i], time).p.x, 0.4)
          << i << time;
    }
  }
  EXPECT_THROW(let_react(scene, followers, X_WB, 8.0, 1.0 / 16, {}), ContractViolation);
}

}  // namespace
}  // namespace saca::reflex::followers_test

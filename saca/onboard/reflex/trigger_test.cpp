#include "saca/onboard/reflex/trigger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "saca/base/world/time_to_conflict.h"
#include "tests/support/scenes.h"

namespace saca::reflex::trigger_test {
namespace {

using test::block;
using test::ego_at;
using test::whole_metres;
using world::Actor;
using world::Scene;

constexpr double exactness = 0.0101;  // conflicts are found to 10 ms

TEST(NearestThreat, IsTheEarliestOfAll) {
  Scene scene = ego_at(20.0, whole_metres);
  scene.actors.push_back(block(1, {84.0, 0.0}, {}));  // 80 m: 4 s
  scene.actors.push_back(
      block(2, {64.0, 0.0}, {5.0, 0.0}));             // 60 m at 15 m/s: 4 s, a tie kept by order
  scene.actors.push_back(block(3, {44.0, 0.0}, {}));  // 40 m: 2 s
  scene.actors.push_back(block(4, {10.0, 3.5}, {}));  // beside the lane
  const auto threat = nearest_threat(scene, 5.5, 0.5);
  ASSERT_TRUE(threat.has_value());
  EXPECT_EQ(threat->actor, 2U);
  EXPECT_NEAR(threat->time, 2.0, exactness);
}

TEST(NearestThreat, EmptySceneHasNone) {
  EXPECT_FALSE(nearest_threat(ego_at(20.0, whole_metres), 5.5, 2.0).has_value());
}

TEST(NearestThreat, AFollowerNeverTriggers) {
  Scene scene = ego_at(10.0, whole_metres);
  scene.actors.push_back(block(1, {-14.0, 0.0}, {25.0, 0.0}));
  EXPECT_TRUE(world::is_behind(scene, scene.actors[0]));
  EXPECT_FALSE(nearest_threat(scene, 5.5, 0.5).has_value());
}

// 20 m/s, 28 m to the bumper: 1.4 s; T1 is 1.3 s. A tick later it is 1.2 s.
TEST(TriggeringThreat, IsTheNearestOnceItIsWithinT1) {
  world::Scene scene = test::ego_at(20.0);
  const double front = support(scene.ego_footprint, {}, {1.0, 0.0}).x;
  scene.actors.push_back(test::car(1, {front + 28.0 + 2.25, 0.0}));
  EXPECT_FALSE(triggering_threat(scene, Thresholds{}).has_value());
  scene.ego.X_WB.p.x += 4.0;
  const auto threat = triggering_threat(scene, Thresholds{});
  ASSERT_TRUE(threat.has_value());
  EXPECT_NEAR(threat->time, 1.2, 0.011);
  EXPECT_FALSE(triggering_threat(scene, Thresholds{.trigger = 1.1}).has_value());
}

// Who drifts out of the lane at 1 m/s meets, 3 s on, who is not in it; in the lane nobody is met.
TEST(MeasuredThreat, IsThereLongBeforeT1ForWhoLeavesTheLane) {
  world::Scene scene = test::ego_at(20.0);
  scene.ego.X_WB.yaw = std::asin(1.0 / 20.0);
  scene.actors.push_back(test::car(1, {20.0 * 3.0, 3.0}));
  EXPECT_FALSE(nearest_threat(scene, Thresholds{}.preview, Thresholds{}.trigger_tolerance));
  EXPECT_FALSE(triggering_threat(scene, Thresholds{}));
  const auto threat = measured_threat(scene, Thresholds{});
  ASSERT_TRUE(threat.has_value());
  EXPECT_GT(threat->time, 2.0);
  EXPECT_LT(threat->time, 3.0);
}

/// A wreck this far ahead of the ego's front [m].
Scene wreck_after(double gap, double speed) {
  Scene scene = ego_at(speed, whole_metres);
  scene.actors.push_back(block(1, {gap + 4.0, 0.0}));
  return scene;
}

// 12 m ahead at 10 m/s: 1.2 s, and 4.2 m/s^2 are needed. 5 m/s^2 are measured, 0.5 of them do not
// count: 11.1 m.
TEST(TriggeringThreat, LeavesADriverAloneWhoStopsShort) {
  Scene scene = wreck_after(12.0, 10.0);
  EXPECT_TRUE(triggering_threat(scene, {}).has_value());
  scene.ego.a_B = {-5.0, 0.0};
  EXPECT_FALSE(triggering_threat(scene, {}).has_value());
  EXPECT_TRUE(nearest_threat(scene, 5.5, 0.5).has_value()) << "who stops braking is in conflict";
}

// 1.5 m/s^2 count: 11 m = 10 t - 0.75 t^2 at 1.21 s.
TEST(TriggeringThreat, IsThereForADriverWhoBrakesTooLittle) {
  Scene scene = wreck_after(11.0, 10.0);
  scene.ego.a_B = {-2.0, 0.0};
  const auto threat = triggering_threat(scene, {});
  ASSERT_TRUE(threat.has_value());
  EXPECT_NEAR(threat->time, (10.0 - std::sqrt(100.0 - 2.0 * 1.5 * 11.0)) / 1.5, exactness);
}

// 20 m ahead at 20 m/s. Bodies of 2 m pass each other 2 m aside: 2.5 m/s across the lane, and 0.5
// that do not count, take the ego there in 1 s.
TEST(TriggeringThreat, LeavesADriverAloneWhoSteersPast) {
  const auto threat_at = [](double across) {
    Scene scene = wreck_after(20.0, 20.0);
    scene.ego.X_WB.yaw = std::asin(across / 20.0);
    return triggering_threat(scene, {});
  };
  EXPECT_TRUE(threat_at(1.0).has_value());
  EXPECT_FALSE(threat_at(3.5).has_value());
}

// A car stands in the next lane; the driver turns towards it.
TEST(TriggeringThreat, SeesADriverTurnIntoAnother) {
  Scene scene = ego_at(15.0, whole_metres);
  scene.actors.push_back(block(1, {19.0, 3.5}));
  EXPECT_FALSE(triggering_threat(scene, {}).has_value());
  scene.ego.yaw_rate = 0.4;  // 5.5 m/s^2 of 6 count: 2.75 m aside in a second
  ASSERT_TRUE(triggering_threat(scene, {}).has_value());
  EXPECT_FALSE(nearest_threat(scene, 5.5, 0.5).has_value());
}

/// From which look on the trigger fires, and from which on it always does; -1: never.
struct Fires {
  int first = -1;
  int settled = -1;
};

/// A drive up to a wreck 30 m ahead, looked at every 10 ms.
/// @param noise  standard deviation of the measured acceleration [m/s^2], white; a fortieth of it
///               [rad/s] is that of the yaw rate
Fires drive_to_wreck(double speed, double deceleration, double noise, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  Fires fires;
  for (int k = 0;; ++k) {
    const double t = 0.01 * k;
    const double now = speed - deceleration * t;
    const double gap = 30.0 - (speed - 0.5 * deceleration * t) * t;
    if (now <= 0.0 || gap <= 0.0) {
      return fires;
    }
    Scene scene = wreck_after(gap, now);
    scene.ego.a_B = {-deceleration + noise * normal(rng), 0.0};
    scene.ego.yaw_rate = noise / 40.0 * normal(rng);
    const bool triggers = triggering_threat(scene, {}).has_value();
    fires.first = triggers && fires.first < 0 ? k : fires.first;
    fires.settled = !triggers ? -1 : fires.settled < 0 ? k : fires.settled;
  }
}

TEST(TriggeringThreat, DoesNotFlickerWithNoise) {
  constexpr double noise = 0.2;
  std::mt19937 rng(3);
  for (int i = 0; i < 20; ++i) {
    // 30 m at 15 m/s: 1.3 s are left after 0.7 s. A beginning is as sharp as without noise.
    const Fires cruising = drive_to_wreck(15.0, 0.0, noise, rng);
    EXPECT_NEAR(cruising.first, 70, 2);
    EXPECT_EQ(cruising.settled, cruising.first);
    // 3.75 m/s^2 are needed: 5.5 do.
    EXPECT_EQ(drive_to_wreck(15.0, 5.5, noise, rng).first, -1);
    // 3.2 do not. The time to conflict falls slowly and depends on the braking: what noise makes of
    // it is over within a tenth of a second.
    const Fires quiet = drive_to_wreck(15.0, 3.2, 0.0, rng);
    const Fires braking = drive_to_wreck(15.0, 3.2, noise, rng);
    EXPECT_GT(quiet.first, 70);
    EXPECT_EQ(quiet.settled, quiet.first);
    EXPECT_NEAR(braking.first, quiet.first, 10);
    EXPECT_LE(braking.settled - braking.first, 10);
  }
}

}  // namespace
}  // namespace saca::reflex::trigger_test

#include "saca/preview/threat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/intent/shipped_model.h"
#include "saca/world/time_to_conflict.h"
#include "tests/support/scenes.h"

namespace saca::preview::threat_test {
namespace {

using test::block;
using test::ego_at;
using test::whole_metres;
using world::Actor;
using world::Scene;

constexpr double exactness = 0.0101;  // conflicts are found to 10 ms

/// As seen for the first time.
std::optional<Threat> previewed(const Scene& scene, const Thresholds& thresholds) {
  return previewed_threat(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), {},
                          thresholds);
}

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
  EXPECT_FALSE(previewed(ego_at(20.0, whole_metres), {}).has_value());
}

TEST(NearestThreat, AFollowerNeverTriggers) {
  Scene scene = ego_at(10.0, whole_metres);
  scene.actors.push_back(block(1, {-14.0, 0.0}, {25.0, 0.0}));
  EXPECT_TRUE(world::is_behind(scene, scene.actors[0]));
  EXPECT_FALSE(nearest_threat(scene, 5.5, 0.5).has_value());
  EXPECT_FALSE(previewed(scene, {}).has_value());
}

// The paper's scene at T2: at constant speed the truck passes behind the ego. The wide tolerance
// starts the preview, the narrow one does not trigger.
TEST(PreviewedThreat, SeesThePapersTruck) {
  Scene scene = ego_at(14.0, whole_metres);
  Actor truck = block(1, {55.0, 43.0}, {0.0, -7.5});
  truck.kind = world::ActorKind::truck;
  truck.footprint = {.length = 8.0, .width = 2.5};
  scene.actors.push_back(truck);
  EXPECT_FALSE(nearest_threat(scene, 5.5, 0.5).has_value());
  const auto threat = previewed(scene, {});
  ASSERT_TRUE(threat.has_value());
  EXPECT_LT(threat->time, 5.5);
}

// It slows a little: going on like that there is no conflict within T2, but it may brake in
// earnest, and that counts where it is likely enough.
TEST(PreviewedThreat, LooksAtEveryLikelyIntention) {
  Scene scene = ego_at(20.0, whole_metres);
  scene.actors.push_back(block(1, {24.0, 0.0}, {20.0, 0.0}));
  scene.actors[0].a_W = {-1.2, 0.0};  // closes 20 m in sqrt(2 * 20 / 1.2) = 5.8 s
  EXPECT_FALSE(nearest_threat(scene, 5.5, 2.0).has_value());
  intent::Belief belief{};
  belief.at.fill({});
  for (intent::IntentPosterior& posterior : belief.at) {
    posterior[static_cast<std::size_t>(intent::Intention::maintain)] = 0.86;
    posterior[static_cast<std::size_t>(intent::Intention::brake)] = 0.14;
  }
  intent::Beliefs beliefs;
  beliefs.push_back(belief);
  const auto threat = previewed_threat(scene, beliefs, {}, {.least_posterior = 0.13});
  ASSERT_TRUE(threat.has_value());
  // From 1.2 m/s^2 the deceleration rises to b within r, then stays: after r the way lost is
  // 1.2 r^2 / 2 + (b - 1.2) r^2 / 6, the speed lost (1.2 + b) r / 2; 20 m at t.
  const intent::MotionLaw law;
  const double b = law.braking;
  const double r = law.braking_rise;
  const double way = 20.0 - 0.6 * r * r - (b - 1.2) * r * r / 6.0;
  const double speed = 0.5 * (1.2 + b) * r;
  const double time = r + (std::sqrt(speed * speed + 2.0 * b * way) - speed) / b;
  EXPECT_NEAR(threat->time, time, exactness);
  EXPECT_FALSE(previewed_threat(scene, beliefs, {}, {.least_posterior = 0.15}).has_value());
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

}  // namespace
}  // namespace saca::preview::threat_test

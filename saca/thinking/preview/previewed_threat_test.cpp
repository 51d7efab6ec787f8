#include "saca/thinking/preview/previewed_threat.h"

#include <gtest/gtest.h>

#include "saca/base/world/time_to_conflict.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/scenes.h"

namespace saca::preview::previewed_threat_test {
namespace {

using test::block;
using test::ego_at;
using test::whole_metres;
using world::Actor;
using world::Scene;

constexpr double exactness = 0.0101;  // conflicts are found to 10 ms

/// As seen for the first time.
std::optional<reflex::Threat> previewed(const Scene& scene, const reflex::Thresholds& thresholds) {
  return previewed_threat(scene, intent::beliefs_at_sight(intent::shipped_model(), scene), {},
                          thresholds);
}

// The paper's scene at T2: at constant speed the truck passes behind the ego. The wide tolerance
// starts the preview, the narrow one does not trigger.
TEST(PreviewedThreat, SeesThePapersTruck) {
  Scene scene = ego_at(14.0, whole_metres);
  Actor truck = block(1, {55.0, 43.0}, {0.0, -7.5});
  truck.kind = world::ActorKind::truck;
  truck.footprint = {.length = 8.0, .width = 2.5};
  scene.actors.push_back(truck);
  EXPECT_FALSE(reflex::nearest_threat(scene, 5.5, 0.5).has_value());
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
  EXPECT_FALSE(reflex::nearest_threat(scene, 5.5, 2.0).has_value());
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

TEST(PreviewedThreat, IsNeitherInAnEmptySceneNorBehind) {
  EXPECT_FALSE(previewed(ego_at(20.0, whole_metres), {}).has_value());
  Scene scene = ego_at(10.0, whole_metres);
  scene.actors.push_back(block(1, {-14.0, 0.0}, {25.0, 0.0}));
  EXPECT_FALSE(previewed(scene, {}).has_value());
}

}  // namespace
}  // namespace saca::preview::previewed_threat_test

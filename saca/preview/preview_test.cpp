#include "saca/preview/preview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/core/contract.h"
#include "saca/intent/shipped_model.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/manoeuvre/ego.h"
#include "tests/support/scenes.h"

namespace saca::preview::preview_test {
namespace {

using test::car;
using world::Actor;
using world::Scene;

/// Two lanes to the left of the ego, one to its right.
Scene motorway(double speed) {
  Scene scene = test::ego_at(speed, manoeuvre::footprint(manoeuvre::default_car()));
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -5.25;
  return scene;
}

std::vector<Situation> look(const Scene& scene, const intent::Beliefs& beliefs) {
  static const manoeuvre::Car car = manoeuvre::default_car();
  static const outcome::HarmModel harm = outcome::read_harm("data/harm.toml").value();
  return situations(scene, beliefs, {}, {.car = &car, .harm = &harm});
}

std::vector<Situation> look(const Scene& scene) {
  return look(scene, intent::beliefs_at_sight(intent::shipped_model(), scene));
}

TEST(Situations, AnEmptyRoadHasNone) {
  EXPECT_TRUE(look(motorway(20.0)).empty());
}

// A wreck 90 m ahead: one certain situation; the trigger comes 1.3 s before the contact.
TEST(Situations, AWreckGivesOneCertainForecast) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  const auto found = look(scene);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].probability, 1.0);
  const Scene& trigger = found[0].scene_at_trigger;
  const double gap = 90.0 - 2.25 - trigger.ego.X_WB.p.x - 2.25;  // half a wreck, the ego's front
  EXPECT_NEAR(gap, 1.3 * 20.0, 20.0 * 0.011);                    // the conflict is found to 10 ms
  EXPECT_NEAR(trigger.time, trigger.ego.X_WB.p.x / 20.0, 1e-9);
  EXPECT_GT(found[0].risks[0].risk, 0.5);
}

TEST(Situations, AreInFallingOrderAndNeverMoreThanThree) {
  Scene scene = motorway(22.0);
  for (std::uint8_t id = 1; id <= 3; ++id) {
    scene.actors.push_back(car(id, {25.0 + 12.0 * id, id == 2 ? 3.5 : 0.0}, {18.0, 0.0}));
    scene.actors[id - 1].a_W = {-1.5, 0.0};  // each may brake or not
  }
  const auto found = look(scene);
  ASSERT_EQ(found.size(), max_situations);
  EXPECT_GE(found[0].probability, found[1].probability);
  EXPECT_GE(found[1].probability, found[2].probability);
  double sum = 0.0;
  for (const Situation& each : found) {
    EXPECT_EQ(each.intentions.size(), 3U);
    sum += each.probability;
  }
  EXPECT_LE(sum, 1.0);
}

TEST(Situations, ALeadThatMayBrakeIsForecastBraking) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {40.0, 0.0}, {20.0, 0.0}));
  scene.actors[0].a_W = {-1.2, 0.0};  // no conflict within T2 unless it brakes harder
  const auto found = look(scene);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].intentions[0], intent::Intention::brake);
  EXPECT_LT(norm(found[0].scene_at_trigger.actors[0].v_W), 20.0);
}

// What happens is what is believed, whatever the car does now.
TEST(Situations, FollowTheBeliefsThatAreHandedIn) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {40.0, 0.0}, {20.0, 0.0}));  // no conflict if it goes on
  intent::Beliefs beliefs;
  beliefs.push_back({});
  beliefs[0].at.fill({0.3, 0.0, 0.0, 0.7});
  const auto found = look(scene, beliefs);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].intentions[0], intent::Intention::brake);
  EXPECT_EQ(found[0].probability, 0.7);
  beliefs[0].at.fill({1.0});
  EXPECT_TRUE(look(scene, beliefs).empty());
  EXPECT_THROW((void)look(scene, intent::Beliefs()), ContractViolation);
}

// The root of the mean of the squares along and across. Along, who sets off the trigger is where
// the trigger finds it: as surely as it is perceived.
TEST(Situations, PlacesAtTheTriggerAreAsUnsureAsTheForecast) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {70.0, 0.0}, {5.0, 0.0}));
  scene.actors.push_back(car(2, {90.0, 3.5}, {20.0, 0.0}));  // beside: in nobody's way
  for (Actor& actor : scene.actors) {
    actor.position_sd = 0.3;
    actor.velocity_sd = 0.1;
  }
  const auto found = look(scene);
  ASSERT_FALSE(found.empty());
  const Scene& trigger = found[0].scene_at_trigger;
  const double t = trigger.time;
  ASSERT_GT(t, 2.0);
  const double perceived = 0.3 * 0.3 + 0.01 * t * t;
  const double wavered = intent::wavering_sd(intent::MotionLaw().driving, t);
  EXPECT_EQ(found[0].intentions[0], intent::Intention::maintain);
  EXPECT_EQ(found[0].intentions[1], intent::Intention::maintain);
  // The forecast is linear between poses 50 ms apart.
  EXPECT_NEAR(trigger.actors[0].position_sd, std::sqrt(0.5 * (0.3 * 0.3 + perceived)), 1e-4);
  EXPECT_NEAR(trigger.actors[1].position_sd, std::sqrt(perceived + 0.5 * wavered * wavered), 1e-3);
}

TEST(Situations, WhoCrossesIsUnsureByTheTriggersTolerance) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {80.0, -32.0}, {0.0, 8.0}));
  scene.actors[0].X_WA.yaw = 0.5 * std::numbers::pi;
  const auto found = look(scene);
  ASSERT_FALSE(found.empty());
  const intent::MotionLaw law;
  const double t = found[0].scene_at_trigger.time;
  const double along = 8.0 * Thresholds().trigger_tolerance / std::sqrt(3.0);
  EXPECT_NEAR(found[0].scene_at_trigger.actors[0].position_sd,
              std::min(along, intent::wavering_sd(law.driving, t)) / std::sqrt(2.0), 1e-4);
}

TEST(Situations, ThosePresentButHarmlessDoNotMultiplyForecasts) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  scene.actors.push_back(car(2, {-60.0, 3.5}, {20.0, 0.0}));
  EXPECT_EQ(look(scene).size(), 1U);
}

}  // namespace
}  // namespace saca::preview::preview_test

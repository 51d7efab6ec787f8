#include "saca/preview/preview.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/manoeuvre/default_car.h"
#include "saca/manoeuvre/ego.h"
#include "saca/outcome/ordering.h"

namespace saca::preview {
namespace {

using manoeuvre::PolicyId;
using world::Actor;
using world::Scene;

outcome::HarmModel test_harm() {
  return outcome::read_harm("data/harm.toml").value();
}

/// Two lanes to the left of the ego, one to its right.
Scene motorway(double speed) {
  Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.ego_footprint = manoeuvre::footprint(manoeuvre::default_car());
  scene.ego_mass = 1'700.0;
  scene.road.left_edge = 8.75;
  scene.road.right_edge = -5.25;
  return scene;
}

Actor car(std::uint8_t id, Vec2 p_W, Vec2 v_W) {
  Actor actor{.id = id, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  actor.X_WA = {p_W, norm(v_W) > 0.0 ? std::atan2(v_W.y, v_W.x) : 0.0};
  actor.v_W = v_W;
  return actor;
}

std::vector<Situation> look(const Scene& scene) {
  return situations(scene, {}, manoeuvre::default_car(), test_harm());
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

TEST(Situations, ThosePresentButHarmlessDoNotMultiplyForecasts) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  scene.actors.push_back(car(2, {-60.0, 3.5}, {20.0, 0.0}));
  EXPECT_EQ(look(scene).size(), 1U);
}

// 26 m to a wreck at 20 m/s on dry road: braking takes 24.9 m (docs/architecture.md), so it just
// stops; going on hits at 20 m/s; both lane changes are clear where the road has the lanes.
TEST(PolicyFacts, SayWhatEachPolicyEndsIn) {
  Scene scene = motorway(20.0);
  scene.actors.push_back(car(1, {90.0, 0.0}, {}));
  const Situation situation = look(scene).at(0);
  const auto& facts = situation.facts;
  const PolicyFacts& nothing = facts[manoeuvre::index(PolicyId::no_intervention)];
  ASSERT_TRUE(nothing.outcome.contact.has_value());
  EXPECT_NEAR(nothing.outcome.contact->relative_speed, 20.0, 0.3);
  EXPECT_EQ(nothing.outcome.contact->ego_face, outcome::Face::front);
  EXPECT_FALSE(facts[manoeuvre::index(PolicyId::es_b_left)].plan.target_speed == std::nullopt);
  EXPECT_TRUE(facts[manoeuvre::index(PolicyId::t_drift_left)].refusal.empty());
  for (const PolicyFacts& fact : facts) {
    if (fact.refusal.empty()) {
      EXPECT_FALSE(outcome::better(fact.outcome, fact.plan.policy,
                                   facts[manoeuvre::index(best_by_forecast(facts))].outcome,
                                   best_by_forecast(facts)))
          << name(fact.plan.policy);
    }
  }
}

// 19.5 m to a wreck at 15 m/s are enough to stop; with a car 4.3 m behind, who brakes is run into
// before it reacts, and who changes the lane is not.
TEST(PolicyFacts, BeingHitFromBehindCounts) {
  Scene scene = motorway(15.0);
  scene.actors.push_back(car(1, {75.0, 0.0}, {}));
  const auto alone = look(scene).at(0).facts;
  scene.actors.push_back(car(2, {-9.0, 0.0}, {15.0, 0.0}));
  const auto followed = look(scene).at(0).facts;
  const auto of = [](const auto& facts, PolicyId policy) -> const outcome::Outcome& {
    return facts[manoeuvre::index(policy)].outcome;
  };
  EXPECT_FALSE(of(alone, PolicyId::aeb).contact.has_value());
  ASSERT_TRUE(of(followed, PolicyId::aeb).contact.has_value());
  EXPECT_EQ(of(followed, PolicyId::aeb).contact->ego_face, outcome::Face::rear);
  EXPECT_GT(of(followed, PolicyId::aeb).harm, of(alone, PolicyId::aeb).harm);
  EXPECT_EQ(of(followed, PolicyId::aes_left).harm, of(alone, PolicyId::aes_left).harm);
}

TEST(BestByForecast, DoesNothingWhereNothingThreatens) {
  const Scene scene = motorway(15.0);
  EXPECT_EQ(best_by_forecast(policy_facts(scene, {}, manoeuvre::default_car(), test_harm())),
            PolicyId::no_intervention);
}

}  // namespace
}  // namespace saca::preview

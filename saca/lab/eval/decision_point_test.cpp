#include "saca/lab/eval/decision_point.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::eval::decision_point_test {
namespace {

using manoeuvre::PolicyId;
using prepare::default_car;

// 15 m/s towards a car 60 m ahead: T1 = 1.3 s are left after (60 - 1.3 * 15) m / (15 m/s) = 2.7 s;
// looked at every 10 ms, and exact to 10 ms.
TEST(DecisionPoint, TheTriggerFiresT1BeforeTheConflict) {
  const auto time = trigger_time(standing_car(15.0, 60.0), default_car());
  ASSERT_TRUE(time.has_value());
  EXPECT_NEAR(*time, 2.7, 0.021);
}

TEST(DecisionPoint, NothingTriggersOnAFreeRoad) {
  scenario::Scenario scenario = standing_car(15.0, 60.0);
  scenario.actors.clear();
  EXPECT_EQ(trigger_time(scenario, default_car()), std::nullopt);
}

TEST(DecisionPoint, IsTheSceneAtThatTime) {
  const scenario::Scenario scenario = standing_car(15.0, 60.0);
  const DecisionPoint point = decision_point_at(scenario, default_car(), 2.0);
  EXPECT_NEAR(point.scene.time, 2.0, 1e-9);
  EXPECT_NEAR(point.scene.ego.X_WB.p.x, 30.0, 1e-9);
  EXPECT_EQ(point.grip, 0.9);
  const manoeuvre::EgoMotion stands{
      .track = {.start = 2.0, .X_WA = {point.scene.ego.X_WB}}, .v_B = {Vec2{}}, .yaw_rate = {0.0}};
  EXPECT_EQ(point.others(stands).size(), 1U);
}

TEST(DecisionPoint, RefusesTimesOutsideTheScenario) {
  const scenario::Scenario scenario = standing_car(15.0, 60.0);
  EXPECT_THROW((void)decision_point_at(scenario, default_car(), -0.1), ContractViolation);
  EXPECT_THROW((void)decision_point_at(scenario, default_car(), 12.5), ContractViolation);
  EXPECT_THROW((void)decision_point_at(scenario, default_car(), std::nan("")), ContractViolation);
}

// From 15 m/s at 1.3 s, 19.5 m: braking needs about 15 m, a lane change passes, doing nothing hits
// with all the speed there is.
TEST(DecisionPoint, AllEightAreTriedFromThere) {
  const scenario::Scenario scenario = standing_car(15.0, 60.0);
  const DecisionPoint point = decision_point_at(scenario, default_car(), 2.7);
  const auto tried = hindsight(point, default_car(), shipped_harm());
  const auto outcome = [&](PolicyId policy) {
    return tried[manoeuvre::index(policy)].facts.outcome();
  };
  EXPECT_FALSE(outcome(PolicyId::aeb).contact.has_value());
  EXPECT_FALSE(outcome(PolicyId::aes_left).contact.has_value());
  ASSERT_TRUE(outcome(PolicyId::no_intervention).contact.has_value());
  EXPECT_NEAR(outcome(PolicyId::no_intervention).contact->relative_speed, 15.0, 0.2);
}

TEST(DecisionPoint, OfTheTriggerIsTheOneAtItsTime) {
  const scenario::Scenario scenario = standing_car(15.0, 60.0);
  const auto trigger = decision_point_at_trigger(scenario, default_car());
  const DecisionPoint same =
      decision_point_at(scenario, default_car(), *trigger_time(scenario, default_car()));
  ASSERT_TRUE(trigger.has_value());
  EXPECT_EQ(trigger->scene.time, same.scene.time);
  EXPECT_EQ(trigger->scene.ego.X_WB.p.x, same.scene.ego.X_WB.p.x);
  EXPECT_EQ(trigger->grip, same.grip);
  scenario::Scenario free = scenario;
  free.actors.clear();
  EXPECT_FALSE(decision_point_at_trigger(free, default_car()).has_value());
}

TEST(DecisionPoint, ThoseThatAreThereAreTriedInTheirPlaces) {
  const scenario::Scenario near = standing_car(15.0, 60.0);
  const scenario::Scenario far = standing_car(15.0, 80.0);
  const auto tried = tried_from({std::nullopt, decision_point_at(near, default_car(), 2.7),
                                 std::nullopt, decision_point_at(far, default_car(), 2.7)},
                                default_car(), shipped_harm(), 2);
  ASSERT_EQ(tried.size(), 4U);
  EXPECT_FALSE(tried[0] || tried[2]);
  const auto clearance = [&](std::size_t i) {
    return (*tried[i])[manoeuvre::index(PolicyId::aeb)].facts.outcome().clearance;
  };
  EXPECT_NEAR(clearance(3) - clearance(1), 20.0, 1e-3);  // the same way, the wreck 20 m farther
}

}  // namespace
}  // namespace saca::eval::decision_point_test

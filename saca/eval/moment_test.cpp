#include "saca/eval/moment.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/eval/scenes_for_test.h"

namespace saca::eval::moment_test {
namespace {

using manoeuvre::default_car;
using manoeuvre::PolicyId;

// 15 m/s towards a car 60 m ahead: T1 = 1.3 s are left after (60 - 1.3 * 15) m / (15 m/s) = 2.7 s;
// looked at every 10 ms, and exact to 10 ms.
TEST(Moment, TheTriggerFiresT1BeforeTheConflict) {
  const auto time = trigger_time(standing_car(15.0, 60.0), default_car());
  ASSERT_TRUE(time.has_value());
  EXPECT_NEAR(*time, 2.7, 0.021);
}

TEST(Moment, NothingTriggersOnAFreeRoad) {
  sim::Scenario scenario = standing_car(15.0, 60.0);
  scenario.actors.clear();
  EXPECT_EQ(trigger_time(scenario, default_car()), std::nullopt);
}

TEST(Moment, IsTheSceneAtThatTime) {
  const sim::Scenario scenario = standing_car(15.0, 60.0);
  const Moment moment = moment_at(scenario, default_car(), 2.0);
  EXPECT_NEAR(moment.scene.time, 2.0, 1e-9);
  EXPECT_NEAR(moment.scene.ego.X_WB.p.x, 30.0, 1e-9);
  EXPECT_EQ(moment.grip, 0.9);
  const manoeuvre::EgoMotion stands{
      .track = {.start = 2.0, .X_WA = {moment.scene.ego.X_WB}}, .v_B = {Vec2{}}, .yaw_rate = {0.0}};
  EXPECT_EQ(moment.others(stands).size(), 1U);
}

TEST(Moment, RefusesTimesOutsideTheScenario) {
  const sim::Scenario scenario = standing_car(15.0, 60.0);
  EXPECT_THROW((void)moment_at(scenario, default_car(), -0.1), ContractViolation);
  EXPECT_THROW((void)moment_at(scenario, default_car(), 12.5), ContractViolation);
  EXPECT_THROW((void)moment_at(scenario, default_car(), std::nan("")), ContractViolation);
}

// From 15 m/s at 1.3 s, 19.5 m: braking needs about 15 m, a lane change passes, doing nothing hits
// with all the speed there is.
TEST(Moment, AllEightAreTriedFromThere) {
  const sim::Scenario scenario = standing_car(15.0, 60.0);
  const Moment moment = moment_at(scenario, default_car(), 2.7);
  const auto tried = hindsight(moment, default_car(), shipped_harm());
  const auto outcome = [&](PolicyId policy) {
    return tried[manoeuvre::index(policy)].facts.outcome();
  };
  EXPECT_FALSE(outcome(PolicyId::aeb).contact.has_value());
  EXPECT_FALSE(outcome(PolicyId::aes_left).contact.has_value());
  ASSERT_TRUE(outcome(PolicyId::no_intervention).contact.has_value());
  EXPECT_NEAR(outcome(PolicyId::no_intervention).contact->relative_speed, 15.0, 0.2);
}

TEST(Moment, OfTheTriggerIsTheOneAtItsTime) {
  const sim::Scenario scenario = standing_car(15.0, 60.0);
  const auto trigger = moment_of_trigger(scenario, default_car());
  const Moment same = moment_at(scenario, default_car(), *trigger_time(scenario, default_car()));
  ASSERT_TRUE(trigger.has_value());
  EXPECT_EQ(trigger->scene.time, same.scene.time);
  EXPECT_EQ(trigger->scene.ego.X_WB.p.x, same.scene.ego.X_WB.p.x);
  EXPECT_EQ(trigger->grip, same.grip);
  sim::Scenario free = scenario;
  free.actors.clear();
  EXPECT_FALSE(moment_of_trigger(free, default_car()).has_value());
}

TEST(Moment, ThoseThatAreThereAreTriedInTheirPlaces) {
  const sim::Scenario near = standing_car(15.0, 60.0);
  const sim::Scenario far = standing_car(15.0, 80.0);
  const auto tried = tried_from({std::nullopt, moment_at(near, default_car(), 2.7), std::nullopt,
                                 moment_at(far, default_car(), 2.7)},
                                default_car(), shipped_harm(), 2);
  ASSERT_EQ(tried.size(), 4U);
  EXPECT_FALSE(tried[0] || tried[2]);
  const auto clearance = [&](std::size_t i) {
    return (*tried[i])[manoeuvre::index(PolicyId::aeb)].facts.outcome().clearance;
  };
  EXPECT_NEAR(clearance(3) - clearance(1), 20.0, 1e-3);  // the same way, the wreck 20 m farther
}

}  // namespace
}  // namespace saca::eval::moment_test

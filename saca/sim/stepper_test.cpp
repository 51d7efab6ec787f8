#include "saca/sim/stepper.h"

#include <gtest/gtest.h>

#include "saca/core/contract.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/sim/motion.h"

namespace saca::sim {
namespace {

/// Ego at 20 m/s; a lead at 15 m/s that brakes at 5 m/s^2 from 1 s on.
Scenario behind_a_braking_lead() {
  Scenario scenario{.name = "lead", .car = "compact_rwd_ev", .grip = 0.9, .duration = 4.0};
  scenario.ego = EgoStart{.pose = {}, .speed = 20.0};
  scenario.actors.push_back({.id = 1,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1'500.0,
                             .motion = Script{.start = {.s = 60.0},
                                              .speed = 15.0,
                                              .behaviour = Behaviour::brake,
                                              .acceleration = 5.0,
                                              .from = 1.0}});
  return scenario;
}

void advance(Stepper& stepper, int num_steps) {
  for (int k = 0; k < num_steps; ++k) {
    stepper.advance({});
  }
}

TEST(Stepper, TimeIsAStepCount) {
  const Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = manoeuvre::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 3'000);
  EXPECT_DOUBLE_EQ(stepper.time(), 3.0);
  EXPECT_FALSE(stepper.over());
  advance(stepper, 1'000);
  EXPECT_TRUE(stepper.over());
}

TEST(Stepper, TheEgoFollowsTheScenarioUntilTheWheelIsTaken) {
  const Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = manoeuvre::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 1'000);
  EXPECT_NEAR(stepper.ego().X_WB.p.x, 20.0, 1e-9);
  stepper.take_the_wheel();
  EXPECT_NEAR(stepper.ego().X_WB.p.x, 20.0, 1e-9);  // no jump
  EXPECT_NEAR(stepper.ego().v_B.x, 20.0, 1e-9);
  EXPECT_THROW(stepper.take_the_wheel(), ContractViolation);
  vehicle::Command brake;
  brake.brake_torque.fill(900.0);
  for (int k = 0; k < 1'000; ++k) {
    stepper.advance(brake);
  }
  EXPECT_LT(stepper.ego().v_B.x, 16.0);
}

TEST(Stepper, PerceivesMotionAsATrackerWould) {
  const Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = manoeuvre::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 900);
  EXPECT_NEAR(stepper.scene().actors[0].v_W.x, 15.0, 1e-6);
  EXPECT_NEAR(stepper.scene().actors[0].a_W.x, 0.0, 1e-6);
  advance(stepper, 1'100);  // it has braked for a second
  const world::Actor lead = stepper.scene().actors[0];
  EXPECT_NEAR(lead.v_W.x, 10.0, 0.05);  // the slope of the last 10 ms
  EXPECT_NEAR(lead.a_W.x, -5.0, 0.1);
  EXPECT_EQ(lead.id, 1);
  EXPECT_FALSE(world::broken_rule(stepper.scene()).has_value());
}

TEST(Stepper, AnActorIsNotThereBeforeItsFirstSample) {
  Scenario scenario = behind_a_braking_lead();
  Recording late{{.time = 2.0, .X_WA = {{80.0, 3.5}, 0.0}, .speed = 10.0},
                 {.time = 4.0, .X_WA = {{100.0, 3.5}, 0.0}, .speed = 10.0}};
  scenario.actors.push_back(
      {.id = 2, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0, .motion = late});
  const manoeuvre::Car car = manoeuvre::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 1'990);
  EXPECT_EQ(stepper.scene().actors.size(), 1U);
  EXPECT_EQ(stepper.tracks().size(), 1U);
  advance(stepper, 20);
  EXPECT_EQ(stepper.scene().actors.size(), 2U);
  EXPECT_EQ(stepper.tracks().size(), 2U);
}

}  // namespace
}  // namespace saca::sim

#include "saca/lab/sim/stepper.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/scenario/motion.h"

namespace saca::sim::stepper_test {
namespace {

/// Ego at 20 m/s; a lead at 15 m/s that brakes at 5 m/s^2 from 1 s on.
scenario::Scenario behind_a_braking_lead() {
  scenario::Scenario scenario{
      .name = "lead", .car = "compact_rwd_ev", .grip = 0.9, .duration = 4.0};
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 20.0};
  scenario.actors.push_back({.id = 1,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1'500.0,
                             .motion = scenario::Script{.start = {.s = 60.0},
                                                        .speed = 15.0,
                                                        .behaviour = scenario::Behaviour::brake,
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
  const scenario::Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = prepare::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 3'000);
  EXPECT_DOUBLE_EQ(stepper.time(), 3.0);
  EXPECT_FALSE(stepper.over());
  advance(stepper, 1'000);
  EXPECT_TRUE(stepper.over());
}

TEST(Stepper, TheEgoFollowsTheScenarioUntilTheWheelIsTaken) {
  const scenario::Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = prepare::default_car();
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
  const scenario::Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = prepare::default_car();
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

manoeuvre::EgoMotion standing_at(double time) {
  return {.track = {.start = time, .X_WA = {Pose{}}}, .v_B = {Vec2{}}, .yaw_rate = {0.0}};
}

TEST(Stepper, AnActorIsNotThereBeforeItsFirstSample) {
  scenario::Scenario scenario = behind_a_braking_lead();
  scenario::Recording late{{.time = 2.0, .X_WA = {{80.0, 3.5}, 0.0}, .speed = 10.0},
                           {.time = 4.0, .X_WA = {{100.0, 3.5}, 0.0}, .speed = 10.0}};
  scenario.actors.push_back(
      {.id = 2, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0, .motion = late});
  const manoeuvre::Car car = prepare::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 1'990);
  EXPECT_EQ(stepper.scene().actors.size(), 1U);
  const world::Scene whole = stepper.whole_scene();
  ASSERT_EQ(whole.actors.size(), 2U);
  EXPECT_EQ(whole.actors[1].X_WA.p.x, 80.0);
  const auto predicted = stepper.others()(standing_at(stepper.time()));
  ASSERT_EQ(predicted.size(), 2U);
  EXPECT_NEAR(predicted[0].start, 1.99, 1e-9);
  EXPECT_NEAR(predicted[1].start, 2.0, 1e-9);
  EXPECT_NEAR(pose_at(predicted[1], 3.0).p.x, 90.0, 1e-9);
  advance(stepper, 20);
  EXPECT_EQ(stepper.scene().actors.size(), 2U);
  EXPECT_NEAR(stepper.others()(standing_at(stepper.time()))[1].start, 2.01, 1e-9);
}

/// The same ego with a car 12 m behind it that follows as it says.
scenario::Scenario ahead_of_a_follower(
    std::variant<scenario::Script, scenario::Recording> follower) {
  scenario::Scenario scenario{
      .name = "follower", .car = "compact_rwd_ev", .grip = 0.9, .duration = 6.0};
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 20.0};
  scenario.actors.push_back({.id = 1,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1'500.0,
                             .motion = std::move(follower)});
  return scenario;
}

scenario::Recording recorded_behind() {
  return {{.time = 0.0, .X_WA = {{-16.6, 0.0}, 0.0}, .speed = 20.0},
          {.time = 6.0, .X_WA = {{103.4, 0.0}, 0.0}, .speed = 20.0}};
}

/// Bumper to bumper [m].
double gap_behind(const Stepper& stepper) {
  const world::Scene scene = stepper.scene();
  return scene.ego.X_WB.p.x - 2.45 - (scene.actors[0].X_WA.p.x + 2.25);
}

// 11.9 m behind at 20 m/s it would need 1.25 s to react: by then the ego, braking with about 8
// m/s^2, has closed 6 m. It stops behind, or not, but it brakes; a recording would drive on
// through.
TEST(Stepper, ARecordedFollowerReactsFromWhenTheWheelIsTaken) {
  const scenario::Scenario scenario = ahead_of_a_follower(recorded_behind());
  const manoeuvre::Car car = prepare::default_car();
  Stepper recorded(scenario, car);
  advance(recorded, 5'000);
  EXPECT_NEAR(gap_behind(recorded), 11.9, 1e-6);  // nobody drives: it keeps to its recording
  Stepper stepper(scenario, car);
  advance(stepper, 1'000);
  stepper.take_the_wheel();
  EXPECT_NEAR(gap_behind(stepper), 11.9, 1e-6);  // no jump
  vehicle::Command brake;
  brake.brake_torque.fill(300.0);
  for (int k = 0; k < 1'200; ++k) {
    stepper.advance(brake);
  }
  const double speed = stepper.scene().actors[0].v_W.x;
  EXPECT_NEAR(speed, 20.0, 0.05);  // not yet: its reaction takes 1.25 s
  for (int k = 0; k < 1'500; ++k) {
    stepper.advance(brake);
  }
  EXPECT_LT(stepper.scene().actors[0].v_W.x, 18.5);
}

// Whatever happens later, motions that agree up to a time have tracks that agree up to it; and what
// was predicted comes true.
TEST(Stepper, OthersForetellWhatTheStepperThenDoes) {
  scenario::Script follow{
      .start = {.s = -16.6}, .speed = 20.0, .behaviour = scenario::Behaviour::follow};
  follow.law = drivers::content_with(drivers::usual_driver(20.0), 20.0, 11.9);
  const scenario::Scenario scenario = ahead_of_a_follower(follow);
  const manoeuvre::Car car = prepare::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 500);
  stepper.take_the_wheel();
  const collision::Others others = stepper.others();
  manoeuvre::EgoMotion motion{
      .track = {.start = stepper.time(), .step = Traffic::step, .X_WA = {stepper.ego().X_WB}},
      .v_B = {stepper.ego().v_B},
      .yaw_rate = {stepper.ego().yaw_rate}};
  std::vector<double> seen{stepper.scene().actors[0].X_WA.p.x};
  vehicle::Command brake;
  brake.brake_torque.fill(500.0);
  for (int k = 1; k <= 4'000; ++k) {
    stepper.advance(brake);
    if (k % 10 == 0) {
      motion.track.X_WA.push_back(stepper.ego().X_WB);
      motion.v_B.push_back(stepper.ego().v_B);
      motion.yaw_rate.push_back(stepper.ego().yaw_rate);
      seen.push_back(stepper.scene().actors[0].X_WA.p.x);
    }
  }
  const world::Track predicted = others(motion).at(0);
  ASSERT_GE(predicted.X_WA.size(), seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_NEAR(predicted.X_WA[k].p.x, seen[k], 1e-9) << k;
  }
  EXPECT_LT(seen.back(), seen.front() + 0.9 * 20.0 * 4.0);  // it did brake
}

TEST(Stepper, ChanceChangesCarGripAndStart) {
  const scenario::Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = prepare::default_car();
  scenario::Chance chance;
  chance.car = {.grip = 0.8, .mass = 1.1, .speed = 0.4};
  Stepper stepper(scenario, car, chance);
  stepper.take_the_wheel();
  EXPECT_NEAR(stepper.ego().v_B.x, 20.4, 1e-9);
  EXPECT_NEAR(stepper.scene().grip, 0.72, 1e-12);
  EXPECT_NEAR(stepper.scene().ego_mass, 1.1 * car.mass, 1e-9);
  const world::Scene seen = stepper.perceive();
  EXPECT_EQ(seen.grip, 0.9);  // it takes the road for what the scenario says
  EXPECT_EQ(seen.ego_mass, car.mass);
}

TEST(Stepper, CuesArePerceivedFromTheStart) {
  scenario::Scenario scenario = behind_a_braking_lead();
  scenario.cues = {{world::CueKind::work_zone, {40.0, -5.0}}};
  const manoeuvre::Car car = prepare::default_car();
  Stepper stepper(scenario, car);
  for (const world::Scene& scene : {stepper.scene(), stepper.perceive()}) {
    ASSERT_EQ(scene.cues.size(), 1U);
    EXPECT_EQ(scene.cues[0].kind, world::CueKind::work_zone);
    EXPECT_EQ(scene.cues[0].p_W.x, 40.0);
  }
}

TEST(Stepper, GhostsArePerceivedButNotThere) {
  scenario::Scenario scenario = behind_a_braking_lead();
  scenario.perception.grip_believed = 0.6;
  scenario.perception.grip_sd = 0.1;
  scenario::ScenarioActor ghost = scenario.actors[0];
  ghost.id = 2;
  ghost.ghost = true;
  ghost.existence = 0.3;
  std::get<scenario::Script>(ghost.motion).start.s = 30.0;
  scenario.actors.insert(scenario.actors.begin(), ghost);
  const manoeuvre::Car car = prepare::default_car();
  Stepper stepper(scenario, car);
  ASSERT_EQ(stepper.scene().actors.size(), 1U);
  EXPECT_EQ(stepper.scene().actors[0].id, 1);
  EXPECT_EQ(stepper.others()(standing_at(0.0)).size(), 1U);
  const world::Scene seen = stepper.perceive();
  ASSERT_EQ(seen.actors.size(), 2U);
  EXPECT_EQ(seen.actors[1].id, 2);
  EXPECT_EQ(seen.actors[1].existence, 0.3);
  EXPECT_EQ(seen.grip, 0.6);
  EXPECT_EQ(seen.grip_sd, 0.1);
  EXPECT_EQ(stepper.scene().grip, 0.9);
}

TEST(Stepper, BetweenTheTrafficsStepsActorsGoOn) {
  const scenario::Scenario scenario = behind_a_braking_lead();
  const manoeuvre::Car car = prepare::default_car();
  Stepper stepper(scenario, car);
  advance(stepper, 507);
  EXPECT_NEAR(stepper.scene().actors[0].X_WA.p.x, 60.0 + 15.0 * 0.507, 1e-9);
}

}  // namespace
}  // namespace saca::sim::stepper_test

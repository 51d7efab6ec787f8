#include "saca/lab/encounter/outcome_recorder.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::encounter::outcome_recorder_test {
namespace {

/// Ego at 20 m/s towards a standing car whose centre is 50 m ahead of it.
scenario::Scenario drive_at_a_wreck(double d) {
  scenario::Scenario scenario{
      .name = "wreck", .car = "compact_rwd_ev", .grip = 0.9, .duration = 6.0};
  scenario.road.left_edge = 8.75;
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 20.0};
  scenario::ScenarioActor wreck{.id = 1,
                                .footprint = {.length = 4.5, .width = 1.8},
                                .mass = 1'500.0,
                                .motion = scenario::Script{.start = {.s = 50.0, .d = d},
                                                           .behaviour = scenario::Behaviour::hold}};
  scenario.actors.push_back(wreck);
  return scenario;
}

/// Looks every 10 ms until contact or the end.
OutcomeRecorder watch(const scenario::Scenario& scenario, const collision::HarmModel& harm) {
  const auto car = prepare::default_car();
  sim::Stepper stepper(scenario, car);
  OutcomeRecorder recorder(harm);
  while (!stepper.over() && !recorder.look(stepper)) {
    for (int k = 0; k < 10; ++k) {
      stepper.advance({});
    }
  }
  return recorder;
}

TEST(OutcomeRecorder, SeesTheContactWhereGeometrySays) {
  const auto harm = prepare::read_harm("data/harm.toml").value();
  const collision::Outcome seen = watch(drive_at_a_wreck(0.0), harm).outcome();
  ASSERT_TRUE(seen.contact.has_value());
  // The ego's front is 2.25 m ahead of its centre of mass, half a wreck is 2.25 m.
  EXPECT_NEAR(seen.contact->time, (50.0 - 2.25 - 2.25) / 20.0, 1e-4);
  EXPECT_NEAR(seen.contact->relative_speed, 20.0, 1e-6);
  EXPECT_EQ(seen.clearance, 0.0);
}

TEST(OutcomeRecorder, KeepsTheSmallestClearance) {
  const auto harm = prepare::read_harm("data/harm.toml").value();
  const collision::Outcome seen = watch(drive_at_a_wreck(3.5), harm).outcome();
  EXPECT_FALSE(seen.contact.has_value());
  EXPECT_NEAR(seen.clearance, 3.5 - 0.95 - 0.9, 1e-3);  // the two half widths
  ASSERT_TRUE(seen.nearest.has_value());
  EXPECT_EQ(seen.nearest->actor, 0U);
  EXPECT_NEAR(seen.nearest->time, 50.0 / 20.0, 4.5 / 20.0);  // while they are abreast
}

// The wreck is 30 m behind after 4 s, and ever farther away.
TEST(OutcomeRecorder, WhatWasPassedBeforeDoesNotCount) {
  const auto harm = prepare::read_harm("data/harm.toml").value();
  const OutcomeRecorder recorder = watch(drive_at_a_wreck(3.5), harm);
  const collision::Outcome since = recorder.outcome_since(4.0);
  EXPECT_GT(since.clearance, 80.0 - 50.0 - 5.0);
  EXPECT_LT(since.clearance, 80.0 - 50.0);
  ASSERT_TRUE(since.nearest.has_value());
  EXPECT_NEAR(since.nearest->time, 4.0, 1e-6);
  EXPECT_EQ(recorder.outcome_since(0.0).clearance, recorder.outcome().clearance);
  EXPECT_THROW((void)recorder.outcome_since(100.0), ContractViolation);
  EXPECT_THROW((void)watch(drive_at_a_wreck(0.0), harm).outcome_since(0.0), ContractViolation);
}

// The ego swerves over a kerb at 20 m/s, slows down, and meets the wreck at 10 m/s.
TEST(OutcomeRecorder, AKerbCrossedBeforeTheContactCountsAsItWasCrossed) {
  const auto harm = prepare::read_harm("data/harm.toml").value();
  scenario::Scenario scenario = drive_at_a_wreck(0.0);
  scenario.road.left_edge = 3.0;
  scenario.road.left_beyond = world::Beyond::kerb;
  scenario.ego = scenario::Recording{{.time = 0.0, .X_WA = {{0.0, 0.0}, 0.0}, .speed = 20.0},
                                     {.time = 1.0, .X_WA = {{20.0, 0.0}, 0.0}, .speed = 20.0},
                                     {.time = 1.5, .X_WA = {{30.0, 2.6}, 0.0}, .speed = 20.0},
                                     {.time = 2.5, .X_WA = {{45.0, 2.6}, 0.0}, .speed = 10.0},
                                     {.time = 4.5, .X_WA = {{65.0, 2.6}, 0.0}, .speed = 10.0}};
  std::get<scenario::Script>(scenario.actors[0].motion).start = {.s = 60.0, .d = 3.5};
  const collision::Outcome seen = watch(scenario, harm).outcome();
  ASSERT_TRUE(seen.contact.has_value());
  ASSERT_EQ(seen.contact->actor, 0U);
  // Without the wreck: the kerb alone; without the kerb: the wreck alone.
  scenario::Scenario kerb = scenario;
  kerb.actors.clear();
  scenario::Scenario wreck = scenario;
  wreck.road.left_edge = 8.75;
  const double of_kerb = watch(kerb, harm).outcome().harm;
  const double of_wreck = watch(wreck, harm).outcome().harm;
  EXPECT_GT(of_kerb, 0.0);
  EXPECT_GT(seen.harm, of_wreck);
  EXPECT_NEAR(seen.harm, of_kerb + of_wreck, 0.05 * of_kerb);  // chances multiply: nearly a sum
}

TEST(OutcomeRecorder, WhoAppearsLaterIsMetLater) {
  const auto harm = prepare::read_harm("data/harm.toml").value();
  scenario::Scenario scenario = drive_at_a_wreck(3.5);
  const scenario::Recording late{{.time = 1.0, .X_WA = {{50.0, 0.0}, 0.0}, .speed = 0.0},
                                 {.time = 6.0, .X_WA = {{50.0, 0.0}, 0.0}, .speed = 0.0}};
  scenario.actors.push_back(
      {.id = 2, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0, .motion = late});
  const auto car = prepare::default_car();
  sim::Stepper stepper(scenario, car);
  OutcomeRecorder recorder(harm);
  while (!stepper.over() && !recorder.look(stepper)) {
    for (int k = 0; k < 10; ++k) {
      stepper.advance({});
    }
    if (stepper.time() < 1.0) {
      EXPECT_FALSE(recorder.outcome().contact.has_value());
    }
  }
  const collision::Outcome seen = recorder.outcome();
  ASSERT_TRUE(seen.contact.has_value());
  EXPECT_EQ(recorder.scene().actors[*seen.contact->actor].id, 2);
  EXPECT_NEAR(seen.contact->time, (50.0 - 2.25 - 2.25) / 20.0, 1e-4);
}

// The wreck is beside; a car runs into the ego from behind: 12 m between centres, 2.45 m of them
// the ego's rear and 2.25 m its own front, at 10 m/s.
TEST(OutcomeRecorder, BeingHitFromBehindCounts) {
  const auto harm = prepare::read_harm("data/harm.toml").value();
  scenario::Scenario scenario = drive_at_a_wreck(3.5);
  scenario.actors.push_back({.id = 2,
                             .footprint = {.length = 4.5, .width = 1.8},
                             .mass = 1'500.0,
                             .motion = scenario::Script{.start = {.s = -12.0}, .speed = 30.0}});
  const collision::Outcome seen = watch(scenario, harm).outcome();
  ASSERT_TRUE(seen.contact.has_value());
  EXPECT_EQ(seen.contact->actor, 1U);
  EXPECT_EQ(seen.contact->ego_face, collision::Face::rear);
  EXPECT_NEAR(seen.contact->time, (12.0 - 2.45 - 2.25) / 10.0, 1e-3);
}

}  // namespace
}  // namespace saca::encounter::outcome_recorder_test

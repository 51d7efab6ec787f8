#include "saca/runtime/avoider.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "saca/core/contract.h"
#include "saca/intent/shipped_model.h"
#include "saca/manoeuvre/default_car.h"
#include "saca/manoeuvre/ego.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::avoider_test {
namespace {

using manoeuvre::PolicyId;
using world::Scene;

/// A car with an avoider on a road of three lanes, its vehicle model driven by it.
class Drive {
 public:
  explicit Drive(double speed, double grip = 0.9)
      : avoider_({.planes = {.forecast = {&car_, &harm_},
                             .costs = {.preview = 0.05, .verdict = 0.03},
                             .clock = &clock_},
                  .intent = &intent::shipped_model()}),
        scene_(test::ego_at(speed, manoeuvre::footprint(car_))) {
    scene_.ego_mass = car_.mass;
    scene_.grip = grip;
    scene_.road.left_edge = 5.25;
    scene_.road.right_edge = -5.25;
    state_ = manoeuvre::rolling_state(car_, scene_.ego, grip);
  }

  Scene& scene() { return scene_; }
  Avoider& avoider() { return avoider_; }

  /// One instant of 10 ms; actors go on evenly.
  Answer step() {
    const Answer answer = avoider_.step(scene_);
    constexpr double dt = 0.001;
    for (int k = 0; k < 10; ++k) {
      const vehicle::Command command = avoider_.control(state_, dt);
      state_ = vehicle::step(car_, state_, command, scene_.grip, dt);
    }
    scene_.time += 0.01;
    scene_.ego = manoeuvre::ego_state(state_);
    for (world::Actor& actor : scene_.actors) {
      actor.X_WA.p = actor.X_WA.p + 0.01 * actor.v_W;
    }
    return answer;
  }

 private:
  SteadyClock clock_;
  manoeuvre::Car car_ = manoeuvre::default_car();
  outcome::HarmModel harm_ = outcome::read_harm("data/harm.toml").value();
  Avoider avoider_;
  Scene scene_;
  vehicle::VehicleState state_;
};

TEST(Avoider, OnAnEmptyRoadTheStackDrives) {
  Drive drive(20.0);
  for (int k = 0; k < 100; ++k) {
    const Answer answer = drive.step();
    EXPECT_FALSE(answer.plan.has_value());
    EXPECT_FALSE(answer.threat.has_value());
  }
  EXPECT_EQ(drive.avoider().decision(), std::nullopt);
}

// Braking from 12 m/s on a dry road takes some 9 m; at T1 there are 15.
TEST(Avoider, StopsBeforeAWreck) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {60.0, 0.0}));
  std::vector<PolicyId> begun;
  for (int k = 0; k < 900; ++k) {
    const Answer answer = drive.step();
    if (answer.begins) {
      begun.push_back(answer.plan.value().policy);
    }
  }
  EXPECT_EQ(begun, std::vector{PolicyId::aeb});
  EXPECT_LT(norm(drive.scene().ego.v_B), 0.1);
  const double front = drive.scene().ego.X_WB.p.x + 2.3;
  EXPECT_LT(front, 60.0 - 2.25);
  EXPECT_GT(front, 60.0 - 2.25 - 8.0);
}

// On wet road braking from 20 m/s takes 43 m; the lane beside is free.
TEST(Avoider, SwervesWhereBrakingHitsAndGivesTheWheelBack) {
  Drive drive(20.0, 0.5);
  drive.scene().actors.push_back(test::car(1, {90.0, 0.0}));
  bool had_plan = false;
  Answer last;
  for (int k = 0; k < 1'200; ++k) {
    last = drive.step();
    had_plan = had_plan || last.plan.has_value();
    const Vec2 apart = drive.scene().ego.X_WB.p - drive.scene().actors[0].X_WA.p;
    ASSERT_FALSE(std::abs(apart.x) < 4.4 && std::abs(apart.y) < 1.7) << "they touch";
  }
  EXPECT_TRUE(had_plan);
  EXPECT_FALSE(last.plan.has_value());
  EXPECT_EQ(drive.avoider().num_encounters(), 1U);
  EXPECT_EQ(drive.avoider().decision(), std::nullopt) << "the next encounter is another";
}

TEST(Avoider, DecidesAnewInTheNextEncounter) {
  Drive drive(14.0);
  for (int encounter = 0; encounter < 2; ++encounter) {
    drive.scene().actors.clear();
    const world::EgoState& ego = drive.scene().ego;
    drive.scene().actors.push_back(test::car(1, {ego.X_WB.p.x + 3.0 * ego.v_B.x, 0.0}));
    bool begun = false;
    for (int k = 0; k < 400 && !begun; ++k) {
      begun = drive.step().begins;
    }
    EXPECT_TRUE(begun) << encounter;
    drive.scene().actors.clear();  // it drives away
    for (int k = 0; k < 400; ++k) {
      (void)drive.step();
    }
    EXPECT_EQ(drive.avoider().num_encounters(), static_cast<std::size_t>(encounter) + 1);
    EXPECT_GT(drive.scene().ego.v_B.x, 2.0) << "the wheel was given back, not a full stop";
  }
}

// Perception drops out 0.3 s before T1 and stays away: everything is carried on, and it triggers.
TEST(Avoider, TriggersWithoutAScene) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {60.0, 0.0}));
  std::optional<double> conflict;
  while (!conflict || *conflict > 1.6) {
    const Answer answer = drive.step();
    conflict = answer.threat ? std::optional(answer.threat->time) : std::nullopt;
    ASSERT_LT(drive.scene().time, 5.0);
  }
  const double lost = drive.scene().time;
  bool begun = false;
  for (int k = 0; k < 45 && !begun; ++k) {
    const Answer answer = drive.avoider().step(lost + 0.01 * k);
    EXPECT_TRUE(answer.degraded);
    begun = answer.begins;
  }
  EXPECT_TRUE(begun);
}

TEST(Avoider, WhateverComesInTheAnswerIsValid) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {30.0, 0.0}));
  (void)drive.step();
  Scene broken = drive.scene();
  broken.ego.v_B.x = std::numeric_limits<double>::quiet_NaN();
  broken.time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(drive.avoider().step(broken).degraded);
  Scene doubled = drive.scene();
  doubled.actors.push_back(doubled.actors[0]);
  EXPECT_TRUE(drive.avoider().step(doubled).degraded);
  bool begun = false;
  for (int k = 0; k < 200 && !begun; ++k) {
    begun = drive.step().begins;
  }
  EXPECT_TRUE(begun);
}

// At pace `real` nothing that is done on the driving thread takes memory.
TEST(Avoider, AllocatesNothingOnTheDrivingThread) {
  const manoeuvre::Car car = manoeuvre::default_car();
  const auto harm = outcome::read_harm("data/harm.toml").value();
  SteadyClock clock;
  Avoider avoider(
      {.planes = {.forecast = {&car, &harm}, .pace = runtime::Pace::real, .clock = &clock},
       .intent = &intent::shipped_model()});
  Scene scene = test::ego_at(12.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  const vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, scene.grip);
  const std::size_t before = num_allocations;
  bool begun = false;
  for (int k = 0; k < 300 && !begun; ++k) {
    begun = avoider.step(scene, clock.now()).begins;
    (void)avoider.control(state, 0.001);
    scene.time += 0.01;
    scene.ego.X_WB.p.x += 0.12;
  }
  EXPECT_EQ(num_allocations, before);
  EXPECT_TRUE(begun);
  EXPECT_EQ(avoider.finish(), "");
}

TEST(Avoider, NeedsWhatItIsMadeOf) {
  EXPECT_THROW(Avoider({}), ContractViolation);
}

}  // namespace
}  // namespace saca::avoider_test

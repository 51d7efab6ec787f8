#include "saca/onboard/reflex/intake.h"

#include <gtest/gtest.h>

#include <limits>

#include "saca/base/world/time_to_conflict.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::reflex::intake_test {
namespace {

using world::Actor;
using world::Scene;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// 20 m/s, a car 50 m ahead at 10 m/s, another beside it at 15 m/s.
Scene road_at(double time) {
  Scene scene = test::ego_at(20.0);
  scene.time = time;
  scene.ego.X_WB.p.x = 20.0 * time;
  scene.actors.push_back(test::car(1, {50.0 + 10.0 * time, 0.0}, {10.0, 0.0}));
  scene.actors.push_back(test::car(2, {50.0 + 15.0 * time, 3.5}, {15.0, 0.0}));
  return scene;
}

const Actor& named(const Scene& scene, std::uint8_t id) {
  for (const Actor& actor : scene.actors) {
    if (actor.id == id) {
      return actor;
    }
  }
  throw std::out_of_range("nobody of that name");
}

TEST(Intake, LeavesAGoodSceneAsItIs) {
  Intake intake;
  const IntakeResult taken = intake.take(road_at(1.0));
  EXPECT_TRUE(taken.usable);
  EXPECT_TRUE(taken.new_drive);
  EXPECT_FALSE(taken.degraded);
  EXPECT_FALSE(intake.take(road_at(1.01)).new_drive);
  EXPECT_EQ(intake.scene().actors.size(), 2U);
  EXPECT_EQ(intake.scene().ego.X_WB.p.x, 20.2);
}

// One NaN drops one actor, and that one is carried on as it moved: 10 m/s for 0.1 s.
TEST(Intake, DropsWhoBreaksARuleAndCarriesItOn) {
  Intake intake;
  (void)intake.take(road_at(1.0));
  Scene broken = road_at(1.1);
  broken.actors[0].v_W.x = nan;
  const IntakeResult taken = intake.take(broken);
  EXPECT_TRUE(taken.usable);
  EXPECT_TRUE(taken.degraded);
  EXPECT_FALSE(world::broken_rule(intake.scene()));
  ASSERT_EQ(intake.scene().actors.size(), 2U);
  const Actor& carried = named(intake.scene(), 1);
  EXPECT_NEAR(carried.X_WA.p.x, 50.0 + 11.0, 1e-9);
  EXPECT_NEAR(carried.v_W.x, 10.0, 1e-9);
  EXPECT_NEAR(carried.age, 0.1, 1e-12);
  EXPECT_GT(carried.velocity_sd, 0.0);
  EXPECT_EQ(named(intake.scene(), 2).age, 0.0);
}

TEST(Intake, CarriesNobodyOnForLongerThanHalfASecond) {
  Intake intake;
  (void)intake.take(road_at(0.0));
  for (int k = 1; k <= 80; ++k) {
    Scene broken = road_at(0.01 * k);
    broken.actors[0].mass = -1.0;
    EXPECT_TRUE(intake.take(broken).usable);
    EXPECT_EQ(intake.scene().actors.size(), 0.01 * k <= 0.5 + 1e-9 ? 2U : 1U) << k;
  }
}

TEST(Intake, WhoIsNotDeliveredAnyMoreIsGone) {
  Intake intake;
  (void)intake.take(road_at(0.0));
  Scene one = road_at(0.01);
  one.actors.clear();
  EXPECT_FALSE(intake.take(one).degraded);
  EXPECT_TRUE(intake.scene().actors.empty());
}

TEST(Intake, OfTwoOfOneNameTheFirstCounts) {
  Intake intake;
  Scene twice = road_at(0.0);
  twice.actors[1].id = 1;
  const IntakeResult taken = intake.take(twice);
  EXPECT_TRUE(taken.usable);
  EXPECT_TRUE(taken.degraded);
  ASSERT_EQ(intake.scene().actors.size(), 1U);
  EXPECT_EQ(intake.scene().actors[0].v_W.x, 10.0);
}

// The ego brakes with 5 m/s2 from 20 m/s and nothing comes for 0.4 s: 20 * 0.4 - 2.5 * 0.16 = 7.6
// m.
TEST(Intake, AStreamThatStallsIsCarriedOnAsEverybodyMoves) {
  Intake intake;
  Scene braking = road_at(2.0);
  braking.ego.a_B.x = -5.0;
  (void)intake.take(braking);
  for (int k = 1; k <= 40; ++k) {
    const IntakeResult taken = intake.carry_on(2.0 + 0.01 * k);
    EXPECT_TRUE(taken.usable && taken.degraded);
  }
  const Scene& scene = intake.scene();
  EXPECT_EQ(intake.began(), 2.0);
  EXPECT_NEAR(scene.time, 0.4, 1e-9);
  EXPECT_NEAR(scene.ego.X_WB.p.x, 40.0 + 7.6, 1e-6);
  EXPECT_NEAR(scene.ego.v_B.x, 18.0, 1e-9);
  EXPECT_NEAR(named(scene, 1).X_WA.p.x, 70.0 + 4.0, 1e-6);
  EXPECT_FALSE(intake.carry_on(2.51).usable) << "nothing has been seen for longer than 0.5 s";
}

TEST(Intake, WhoBrakesToRestStaysThere) {
  Intake intake;
  Scene braking = road_at(0.0);
  braking.ego.v_B = {1.0, 0.0};
  braking.ego.a_B.x = -5.0;
  (void)intake.take(braking);
  (void)intake.carry_on(0.45);
  EXPECT_NEAR(intake.scene().ego.X_WB.p.x, 0.1, 1e-9);  // v^2 / 2a
  EXPECT_EQ(norm(intake.scene().ego.v_B), 0.0);
}

TEST(Intake, AnEgoThatBreaksARuleIsCarriedOn) {
  Intake intake;
  (void)intake.take(road_at(0.0));
  Scene broken = road_at(0.1);
  broken.ego.v_B.x = infinity;
  const IntakeResult taken = intake.take(broken);
  EXPECT_TRUE(taken.usable && taken.degraded);
  EXPECT_NEAR(intake.scene().ego.X_WB.p.x, 2.0, 1e-9);
}

TEST(Intake, TimeThatJumpsBeginsANewDrive) {
  Intake intake;
  (void)intake.take(road_at(10.0));
  EXPECT_TRUE(intake.take(road_at(8.5)).new_drive);
  EXPECT_FALSE(intake.take(road_at(9.4)).new_drive);
  EXPECT_TRUE(intake.take(road_at(10.5)).new_drive);
  EXPECT_FALSE(intake.take(road_at(10.5)).new_drive) << "the same instant again";
}

TEST(Intake, ASceneThatComesLateIsLeftAside) {
  Intake intake;
  (void)intake.take(road_at(10.0));
  const IntakeResult late = intake.take(road_at(9.9));
  EXPECT_FALSE(late.usable);
  EXPECT_FALSE(late.new_drive);
  EXPECT_EQ(intake.scene().time, 0.0);
  EXPECT_TRUE(intake.take(road_at(10.01)).usable);
}

// Perception whose clock counts from 1970, to a microsecond: the same as from 0.
TEST(Intake, WhateverTheClockCountsFrom) {
  constexpr double day = 1.8e9;
  Intake near;
  Intake far;
  for (int k = 0; k < 300; ++k) {
    const double time = 0.01 * k;
    Scene there = road_at(time);
    there.time += day;
    const bool comes = k < 100 || k > 140;
    const IntakeResult a = comes ? near.take(road_at(time)) : near.carry_on(time);
    const IntakeResult b = comes ? far.take(there) : far.carry_on(day + time);
    ASSERT_TRUE(a.usable && b.usable) << k;
    EXPECT_EQ(a.new_drive, b.new_drive) << k;
    EXPECT_NEAR(near.scene().time, far.scene().time, 1e-6) << k;
    EXPECT_NEAR(near.scene().ego.X_WB.p.x, far.scene().ego.X_WB.p.x, 1e-4) << k;
  }
  EXPECT_EQ(far.began(), day);
}

TEST(Intake, TimeThatNobodyCountsIsNoTime) {
  Intake intake;
  (void)intake.take(road_at(0.0));
  Scene absurd = road_at(0.1);
  absurd.time = 1e12;  // milliseconds since 1970
  const IntakeResult taken = intake.take(absurd);
  EXPECT_FALSE(taken.new_drive) << "what is under way goes on";
  EXPECT_TRUE(taken.degraded);
  EXPECT_EQ(intake.scene().time, 0.0);
}

TEST(Intake, NothingThatIsUsableBreaksARule) {
  for (const double wrong : {nan, infinity, -infinity, 1e300, -1e300, -1.0}) {
    Scene good = road_at(0.1);
    const auto spoiled = [&](auto&& spoil) {
      Scene scene = good;
      spoil(scene);
      return scene;
    };
    const Scene all[] = {spoiled([&](Scene& s) { s.time = wrong; }),
                         spoiled([&](Scene& s) { s.ego.X_WB.p.y = wrong; }),
                         spoiled([&](Scene& s) { s.ego.X_WB.yaw = wrong; }),
                         spoiled([&](Scene& s) { s.ego.yaw_rate = wrong; }),
                         spoiled([&](Scene& s) { s.ego.a_B.x = wrong; }),
                         spoiled([&](Scene& s) { s.ego_mass = wrong; }),
                         spoiled([&](Scene& s) { s.road.lane_width = wrong; }),
                         spoiled([&](Scene& s) { s.grip = wrong; }),
                         spoiled([&](Scene& s) { s.actors[0].X_WA.p.x = wrong; }),
                         spoiled([&](Scene& s) { s.actors[0].footprint.length = wrong; }),
                         spoiled([&](Scene& s) { s.actors[0].existence = wrong; }),
                         spoiled([&](Scene& s) { s.actors[0].age = wrong; }),
                         spoiled([&](Scene& s) { s.actors[1].shared.brake = wrong; })};
    for (const Scene& scene : all) {
      Intake fresh;
      if (fresh.take(scene).usable) {
        EXPECT_FALSE(world::broken_rule(fresh.scene()));
      }
      Intake known;
      (void)known.take(road_at(0.0));
      if (known.take(scene).usable) {
        EXPECT_FALSE(world::broken_rule(known.scene()));
      }
    }
  }
}

// Backwards at 2 m/s: 0.2 m in 0.1 s, whether the brakes hold it or it gathers speed a little.
TEST(Intake, WhoRollsBackIsCarriedOnBackwards) {
  for (const double a : {-0.05, 0.0, 0.05, -1e-9}) {
    Intake intake;
    Scene rolling = road_at(0.0);
    rolling.ego.v_B = {-2.0, 0.0};
    rolling.ego.a_B.x = a;
    (void)intake.take(rolling);
    EXPECT_TRUE(intake.carry_on(0.1).usable);
    EXPECT_NEAR(intake.scene().ego.X_WB.p.x, -0.2, 1e-3) << a;
    EXPECT_NEAR(intake.scene().ego.v_B.x, -2.0, 0.01) << a;
  }
  Intake intake;
  Scene braking = road_at(0.0);
  braking.ego.v_B = {-1.0, 0.0};
  braking.ego.a_B.x = 5.0;
  (void)intake.take(braking);
  (void)intake.carry_on(0.45);
  EXPECT_NEAR(intake.scene().ego.X_WB.p.x, -0.1, 1e-9) << "v^2 / 2a";
  EXPECT_EQ(norm(intake.scene().ego.v_B), 0.0);
}

// What is within bounds now is beyond them when it is carried on.
TEST(Intake, NobodyIsCarriedOnBeyondTheBounds) {
  Intake intake;
  Scene fast = road_at(0.0);
  fast.actors[0].v_W.x = 195.0;
  fast.actors[0].a_W.x = 1'000.0;
  (void)intake.take(fast);
  Scene broken = road_at(0.2);
  broken.actors[0].mass = nan;
  EXPECT_TRUE(intake.take(broken).usable);
  EXPECT_EQ(world::broken_rule(intake.scene()), std::nullopt);
  EXPECT_EQ(intake.scene().actors.size(), 1U);

  Intake stalled;
  (void)stalled.take(fast);
  EXPECT_TRUE(stalled.carry_on(0.2).usable);
  EXPECT_EQ(world::broken_rule(stalled.scene()), std::nullopt);

  Intake ego;
  fast = road_at(0.0);
  fast.ego.v_B.x = 195.0;
  fast.ego.a_B.x = 1'000.0;
  (void)ego.take(fast);
  EXPECT_FALSE(ego.carry_on(0.2).usable);
  EXPECT_TRUE(ego.take(road_at(0.21)).usable);
}

// 20 scenes a second that come 30 ms late, and a stack that asks every 10 ms.
TEST(Intake, ScenesThatAreOlderThanWhatIsCarriedOnToAreTakenAllTheSame) {
  Intake intake;
  double before = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double now = 0.01 * k;
    const bool comes = k % 5 == 3;
    Scene late = road_at(now - 0.03);
    if (k >= 50 && k < 80) {
      late.actors[1].mass = nan;  // of the second nothing can be used for 0.3 s
    }
    if (k == 103) {
      late.grip = nan;
    }
    const IntakeResult taken = comes ? intake.take(late) : intake.carry_on(now);
    if (k >= 3) {
      ASSERT_TRUE(taken.usable) << k;
      EXPECT_GE(intake.scene().time, before) << k;
      EXPECT_NEAR(intake.scene().ego.X_WB.p.x, 20.0 * (intake.began() + intake.scene().time), 1e-6)
          << k;
      EXPECT_NEAR(named(intake.scene(), 2).X_WA.p.x,
                  50.0 + 15.0 * (intake.began() + intake.scene().time), 1e-6)
          << k;
      EXPECT_LE(named(intake.scene(), 1).age, k >= 103 && k < 108 ? 0.131 : 0.081) << k;
      before = intake.scene().time;
    }
  }
}

// On a circle of 20 m radius, X_WL where the ego came in: 165 degrees further on a car stands 10 m
// ahead.
TEST(Intake, FarRoundABendAheadIsAhead) {
  for (const double side : {1.0, -1.0}) {
    Scene scene = test::ego_at(5.0);
    scene.road.curvature = side / 20.0;
    scene.ego.X_WB = world::from_lane(scene.road, {57.6, 0.3, 0.1});
    Actor ahead = test::car(1, {});
    ahead.X_WA = world::from_lane(scene.road, {67.6, 0.0, 0.0});
    Actor behind = test::car(2, {});
    behind.X_WA = world::from_lane(scene.road, {47.6, 0.0, 0.0});
    scene.actors.push_back(ahead);
    scene.actors.push_back(behind);
    ASSERT_TRUE(world::is_behind(scene, ahead)) << "s begins anew between them";
    Intake intake;
    ASSERT_TRUE(intake.take(scene).usable);
    const Scene& seen = intake.scene();
    EXPECT_FALSE(world::is_behind(seen, seen.actors[0]));
    EXPECT_TRUE(world::is_behind(seen, seen.actors[1]));
    const world::LanePose here = world::to_lane(seen.road, seen.ego.X_WB);
    EXPECT_NEAR(here.s, 0.0, 1e-9);
    EXPECT_NEAR(here.d, 0.3, 1e-9);
    EXPECT_NEAR(here.heading, 0.1, 1e-9);
  }
}

TEST(Intake, AllocatesNothing) {
  Intake intake;
  Scene broken = road_at(0.1);
  broken.actors[0].v_W.x = nan;
  const std::size_t before = num_allocations;
  (void)intake.take(road_at(0.0));
  (void)intake.take(broken);
  (void)intake.carry_on(0.2);
  EXPECT_EQ(num_allocations, before);
}

}  // namespace
}  // namespace saca::reflex::intake_test

#include "saca/lab/suites/shadow.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::suites::shadow_test {
namespace {

using testing::HasSubstr;

constexpr double front = 2.25;  // of the ego's body ahead of its centre of mass [m]

/// Along x: from `x` at a speed, from `brakes_at` on with a deceleration to rest.
struct Way {
  double x = 0.0;
  double speed = 0.0;
  double brakes_at = 1e9;
  double deceleration = 1.0;

  [[nodiscard]] scenario::Sample at(double time) const {
    const double braking = std::min(std::max(0.0, time - brakes_at), speed / deceleration);
    const double cruising = std::min(time, brakes_at);
    return {time,
            {{x + speed * (cruising + braking) - 0.5 * deceleration * braking * braking, 0.0}, 0.0},
            speed - deceleration * braking,
            0.0};
  }
  [[nodiscard]] scenario::Recording recording(double from, double to) const {
    scenario::Recording samples;
    for (int k = static_cast<int>(std::lround(10.0 * from)); k <= std::lround(10.0 * to); ++k) {
      samples.push_back(at(0.1 * k));
    }
    return samples;
  }
};

class Shadow : public testing::Test {
 protected:
  Shadow() {
    scenario_.name = "made";
    scenario_.duration = 60.0;
    scenario_.road.left_edge = 7.0;
    scenario_.road.right_edge = -7.0;
  }
  void drive(const Way& way, double seconds) { scenario_.ego = way.recording(0.0, seconds); }
  /// @param rear  of a car at `way.x` = 0 [m]
  void add(double rear, Way way, double from, double to) {
    way.x = rear + 2.25;
    scenario_.actors.push_back({.id = static_cast<std::uint8_t>(scenario_.actors.size() + 1),
                                .footprint = {.length = 4.5, .width = 1.8},
                                .mass = 1500.0,
                                .motion = way.recording(from, to)});
  }
  ShadowDrive watched(const eval::ShadowWindow& window = {}) {
    const auto drive = shadow_drive(scenario_, setup_, window);
    EXPECT_TRUE(drive.has_value()) << drive.error().message;
    return drive.value();
  }
  std::string refusal() {
    const auto drive = shadow_drive(scenario_, setup_);
    EXPECT_FALSE(drive.has_value());
    return drive.has_value() ? "" : drive.error().message;
  }

  manoeuvre::Car car_ = prepare::default_car();
  ShadowSetup setup_{&car_, &intent::shipped_model(), {}};
  scenario::Scenario scenario_;
};

TEST_F(Shadow, WhoFollowsAtConstantSpeedSetsOffNothing) {
  drive({.speed = 15.0}, 4.0);
  add(front + 20.0, {.speed = 15.0}, 0.0, 4.0);
  const ShadowDrive seen = watched();
  EXPECT_TRUE(seen.triggers.empty());
  EXPECT_NEAR(seen.seconds, 4.0, 1e-9);
  EXPECT_NEAR(seen.metres, 60.0, 1e-6);
}

// At 15 m/s the rear at 80 m is 1.3 s away when the front is at 60.5 m, after 3.883 s: at the look
// at 3.89 s, or, time to conflict being exact to 10 ms, one beside it. From 3.9 s on he brakes with
// 6.5 m/s^2, which takes 17.3 m of the 19.25 m.
TEST_F(Shadow, WhoStopsLateSetsOffOneTrigger) {
  drive({.speed = 15.0, .brakes_at = 3.9, .deceleration = 6.5}, 10.0);
  add(80.0, {}, 0.0, 10.0);
  const ShadowDrive seen = watched();
  ASSERT_EQ(seen.triggers.size(), 1U);
  const ShadowTrigger& trigger = seen.triggers[0];
  EXPECT_NEAR(trigger.time, 3.885, 0.0151);
  EXPECT_NEAR(trigger.time_to_conflict, 1.295, 0.0101);
  EXPECT_EQ(trigger.who, "car1");
  EXPECT_NEAR(trigger.speed, 15.0, 1e-9);
  EXPECT_EQ(trigger.judgement.reason, eval::ShadowReason::driver_braked);
  EXPECT_NEAR(trigger.judgement.driver_deceleration, 6.5, 1e-6);
  EXPECT_NEAR(trigger.judgement.least_gap, 80.0 - front - 58.5 - 225.0 / 13.0, 0.02);
  // 82.5 m or less are within T2: from the beginning.
  ASSERT_EQ(seen.previews.size(), 1U);
  EXPECT_EQ(seen.previews[0].from, 0.0);
  EXPECT_EQ(seen.previews[0].who, "car1");
  EXPECT_GT(seen.previews[0].to, trigger.time);
  EXPECT_NEAR(seen.seconds, 10.0, 1e-9);
  EXPECT_NEAR(seen.metres, 58.5 + 225.0 / 13.0, 1e-6);
}

// 15 m ahead at 15 m/s somebody stands, seen in one look, or in two: the reflex plane waits for the
// second.
TEST_F(Shadow, NobodyTriggersBeforeHeIsConfirmed) {
  for (const auto& [until, triggers] : {std::pair(2.005, 0U), std::pair(2.015, 1U)}) {
    scenario_.actors.clear();
    drive({.speed = 15.0}, 4.0);
    scenario::Recording seen;
    for (const double time : {2.0, until}) {
      seen.push_back({time, {{15.0 * 2.0 + front + 15.0 + 2.25, 0.0}, 0.0}, 0.0, 0.0});
    }
    scenario_.actors.push_back(
        {.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1500.0, .motion = seen});
    const ShadowDrive watched_drive = watched();
    ASSERT_EQ(watched_drive.triggers.size(), triggers);
    if (triggers > 0) {
      EXPECT_NEAR(watched_drive.triggers[0].time, 2.01, 1e-9);
    }
  }
}

TEST_F(Shadow, ExposureEndsWhereItIsToldTo) {
  drive({.speed = 15.0, .brakes_at = 3.9, .deceleration = 6.5}, 10.0);
  add(80.0, {}, 0.0, 10.0);
  const ShadowDrive seen = watched({.until = 2.0});
  EXPECT_TRUE(seen.triggers.empty());
  EXPECT_NEAR(seen.seconds, 2.0, 1e-9);
  EXPECT_NEAR(seen.metres, 30.0, 1e-6);
}

// A trigger that holds already counts from the first look on: 5.8 m/s^2 are needed, he brakes with
// 2.
TEST_F(Shadow, NothingCountsBeforeTheWindow) {
  drive({.speed = 15.0, .brakes_at = 3.9, .deceleration = 2.0}, 10.0);
  add(80.0, {}, 0.0, 10.0);
  const ShadowDrive seen = watched({.from = 4.5, .until = 5.0});
  ASSERT_EQ(seen.triggers.size(), 1U);
  EXPECT_NEAR(seen.triggers[0].time, 4.5, 1e-9);
  EXPECT_NEAR(seen.seconds, 0.5, 1e-9);
  // From 0.6 to 1.1 s after the brakes: 15 x 0.5 - 1.1^2 + 0.6^2.
  EXPECT_NEAR(seen.metres, 7.5 - 0.85, 0.01);
}

// 0.6 s after the brakes 9.5 m are left at 11.1 m/s: 0.86 s, if he did not brake.
TEST_F(Shadow, WhoBrakesEnoughSetsOffNothing) {
  drive({.speed = 15.0, .brakes_at = 3.9, .deceleration = 6.5}, 10.0);
  add(80.0, {}, 0.0, 10.0);
  EXPECT_TRUE(watched({.from = 4.5, .until = 5.0}).triggers.empty());
}

// T1 ahead at 10 m/s is 13 m: the road ends, 50 m on, for who is beyond 37 m.
TEST_F(Shadow, NothingCountsWhereTheLaneIsNotKnown) {
  drive({.speed = 10.0}, 6.0);
  const ShadowDrive seen = watched({.lane_ahead = 50.0});
  EXPECT_NEAR(seen.seconds, 3.7, 0.011);
  EXPECT_NEAR(watched().seconds, 6.0, 1e-9);
}

TEST_F(Shadow, NothingCountsOfWhoTurnsOff) {
  scenario::Recording turning;
  for (int k = 0; k <= 60; ++k) {  // heads 10 deg further to the left every second from 2 s on
    const double t = 0.1 * k;
    turning.push_back(
        {t, {{10.0 * t, 0.0}, from_degrees(10.0 * std::max(0.0, t - 2.0))}, 10.0, 0.0});
  }
  scenario_.ego = turning;
  EXPECT_NEAR(watched({.lane_ahead = 500.0}).seconds, 4.0, 0.011);
}

// The first is within 1.3 s at 10 m/s from 0.875 s on and gone after 1.5 s; the second is so near
// from 2.675 s on, or, 38 m farther, from 6.475 s on.
TEST_F(Shadow, IsArmedAgainAfterTwoSecondsWithout) {
  for (const auto& [rear, last, num_triggers] :
       {std::tuple{42.0, 3.0, 1U}, std::tuple{80.0, 7.0, 2U}}) {
    scenario_.actors.clear();
    drive({.speed = 10.0}, last);
    add(24.0, {}, 0.0, 1.5);
    add(rear, {}, 0.0, last);
    const ShadowDrive seen = watched();
    ASSERT_EQ(seen.triggers.size(), num_triggers);
    EXPECT_NEAR(seen.triggers.front().time, 0.885, 0.0151);
    EXPECT_EQ(seen.triggers.front().who, "car1");
    if (num_triggers == 2U) {
      EXPECT_NEAR(seen.triggers.back().time, 6.485, 0.0151);
      EXPECT_EQ(seen.triggers.back().who, "car2");
    }
  }
}

// Gone before anybody is within 1.3 s.
TEST_F(Shadow, NobodyIsThereBeyondTheLastSample) {
  drive({.speed = 10.0}, 2.0);
  add(24.0, {}, 0.0, 0.8);
  EXPECT_TRUE(watched().triggers.empty());
}

TEST_F(Shadow, APictureShowsWhatWasAndWhatWasSupposed) {
  drive({.speed = 15.0, .brakes_at = 3.9, .deceleration = 6.5}, 10.0);
  add(80.0, {}, 0.0, 10.0);
  const ShadowTrigger trigger = watched().triggers.at(0);
  const ShadowPicture picture = shadow_picture(scenario_, setup_, trigger);
  EXPECT_NEAR(picture.scene.time, trigger.time, 1e-9);
  EXPECT_NEAR(world::end_time(picture.ego), trigger.time + 3.0, 1e-9);
  EXPECT_NEAR(world::pose_at(picture.ego, 6.9).p.x, 58.5 + 225.0 / 13.0, 0.02);
  EXPECT_NEAR(world::pose_at(picture.supposed_ego, trigger.time + 1.0).p.x,
              15.0 * (trigger.time + 1.0), 1e-6);
  ASSERT_EQ(picture.others.size(), 1U);
  ASSERT_EQ(picture.supposed_others.size(), 1U);
}

/// Likewise, SACA deciding.
class ShadowOfSaca : public Shadow {
 protected:
  ShadowOfSaca() { setup_.saca = &planes_; }

  collision::HarmModel harm_ = eval::shipped_harm();
  SteadyClock clock_;
  runtime::PlanesSetup planes_{.forecast = {&car_, &harm_}, .clock = &clock_};
};

// At 35 m/s full braking on a grip of 0.9 takes 69 m and what the brakes' lag adds, and 45.5 m are
// left at T1: SACA must act 2 s before. The driver brakes with 8 m/s^2 1.5 s before he is there:
// that takes 77 m, and 52.5 m are left.
TEST_F(ShadowOfSaca, ActsBeforeT1WhereThatIsTooLate) {
  scenario_.road.left_edge = 1.75;
  scenario_.road.right_edge = -1.75;
  scenario_.road.left_beyond = scenario_.road.right_beyond = world::Beyond::barrier;
  drive({.speed = 35.0, .brakes_at = 4.9, .deceleration = 8.0}, 10.0);
  add(35.0 * 6.4 + front, {}, 0.0, 10.0);
  const ShadowDrive seen = watched();
  ASSERT_EQ(seen.triggers.size(), 1U);
  ASSERT_GE(seen.interventions.size(), 1U);
  const ShadowIntervention& first = seen.interventions[0];
  EXPECT_TRUE(first.early);
  EXPECT_THAT(first.plan, HasSubstr("AEB"));
  EXPECT_EQ(first.trigger.who, "car1");
  EXPECT_GT(first.trigger.time_to_conflict, 1.5);
  EXPECT_LT(first.trigger.time_to_conflict, 2.5);
  EXPECT_NEAR(first.trigger.time + first.trigger.time_to_conflict, 6.4, 0.05);
  EXPECT_LT(first.trigger.time, seen.triggers[0].time);
  EXPECT_TRUE(is_danger(first.trigger.judgement.reason));
}

// Who drives on in the next lane threatens nobody.
TEST_F(ShadowOfSaca, DoesNothingBesideWhoKeepsHisLane) {
  drive({.speed = 25.0}, 6.0);
  Way beside{.x = 30.0, .speed = 20.0};
  scenario::Recording recording = beside.recording(0.0, 6.0);
  for (scenario::Sample& sample : recording) {
    sample.X_WA.p.y = 3.5;
  }
  scenario_.actors.push_back(
      {.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1500.0, .motion = recording});
  EXPECT_TRUE(watched().interventions.empty());
}

TEST_F(ShadowOfSaca, IsOfTheSameCar) {
  drive({.speed = 10.0}, 3.0);
  const manoeuvre::Car other = prepare::default_car();
  planes_.forecast.car = &other;
  EXPECT_THROW((void)shadow_drive(scenario_, setup_), ContractViolation);
}

TEST_F(Shadow, WhatCannotBeWatchedIsRefused) {
  scenario_.ego = scenario::EgoStart{};
  EXPECT_THAT(refusal(), HasSubstr("made: ego: want a recording"));
  drive({.speed = 10.0}, 0.9);
  EXPECT_THAT(refusal(), HasSubstr("from 0 to 1 s or more"));
  scenario_.ego = Way{.speed = 10.0}.recording(0.5, 3.0);
  EXPECT_THAT(refusal(), HasSubstr("from 0 to 1 s or more"));
  drive({.speed = 10.0}, 3.0);
  std::get<scenario::Recording>(scenario_.ego)[4].X_WA.p.y = std::nan("");
  EXPECT_THAT(refusal(), HasSubstr("ego: sample 4: want finite numbers"));
  drive({.speed = 10.0}, 3.0);
  std::get<scenario::Recording>(scenario_.ego)[4].time = 0.3;
  EXPECT_THAT(refusal(), HasSubstr("times that grow"));
  drive({.speed = 10.0}, 3.0);
  add(50.0, {}, 0.0, 3.0);
  std::get<scenario::Recording>(scenario_.actors[0].motion)[2].speed = std::nan("");
  EXPECT_THAT(refusal(), HasSubstr("car1: sample 2"));
}

TEST_F(Shadow, WantsCarAndModelAndTime) {
  drive({.speed = 10.0}, 3.0);
  EXPECT_THROW((void)shadow_drive(scenario_, {}), ContractViolation);
  EXPECT_THROW((void)shadow_drive(scenario_, setup_, {.until = 0.0}), ContractViolation);
  EXPECT_THROW((void)shadow_drive(scenario_, setup_, {.from = -1.0}), ContractViolation);
  EXPECT_THROW((void)shadow_drive(scenario_, setup_, {.from = 2.0, .until = 1.0}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::suites::shadow_test

#include "saca/lab/eval/shadow_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::eval::shadow_judge_test {
namespace {

/// 6 s of a motion: where, and how fast.
scenario::Recording recorded(const std::function<Vec2(double)>& place,
                             const std::function<double(double)>& speed, double yaw = 0.0) {
  scenario::Recording samples;
  for (int k = 0; k <= 60; ++k) {
    samples.push_back({0.1 * k, {place(0.1 * k), yaw}, speed(0.1 * k), 0.0});
  }
  return samples;
}

scenario::Recording standing(double x, double y = 0.0) {
  return recorded([=](double) { return Vec2{x, y}; }, [](double) { return 0.0; });
}

/// Along x from the origin; brakes from 1 s on to rest.
scenario::Recording braking(double v, double a) {
  const auto t_braked = [=](double t) { return std::min(std::max(0.0, t - 1.0), v / a); };
  return recorded(
      [=](double t) {
        const double b = t_braked(t);
        return Vec2{v * (std::min(t, 1.0) + b) - 0.5 * a * b * b, 0.0};
      },
      [=](double t) { return v - a * t_braked(t); });
}

ShadowJudgement judgement(scenario::Recording ego, scenario::Recording other, double time = 1.0,
                          const ShadowWindow& window = {}) {
  scenario::Scenario scenario;
  scenario.road.left_edge = 20.0;
  scenario.road.right_edge = -20.0;
  scenario.duration = 10.0;
  scenario.ego = std::move(ego);
  scenario.actors.push_back(
      {.footprint = {.length = 4.5, .width = 1.8}, .mass = 1500.0, .motion = std::move(other)});
  return judged(scenario, scenario::standard_ego, 0, time, window);
}

// In a queue: 3 m/s, 3.5 m to go, 1.17 s. He needs 9 / 7 = 1.29 m/s^2 and uses 1.5.
TEST(ShadowJudge, RollingUpInAQueueIsNoDanger) {
  const ShadowJudgement told = judgement(braking(3.0, 1.5), standing(3.0 + 2.25 + 3.5 + 2.25));
  EXPECT_EQ(told.reason, ShadowReason::nothing_needed);
  EXPECT_FALSE(is_danger(told.reason));
  EXPECT_NEAR(told.needed_deceleration.value(), 9.0 / 7.0, 0.11);
  EXPECT_NEAR(told.driver_deceleration, 1.5, 1e-6);
  EXPECT_NEAR(told.least_gap, 0.5, 0.02);
}

TEST(ShadowJudge, HardBrakingIsDangerWhoeverBrakes) {
  const ShadowJudgement his = judgement(braking(15.0, 5.0), standing(60.0));
  EXPECT_EQ(his.reason, ShadowReason::driver_braked);
  EXPECT_NEAR(his.driver_deceleration, 5.0, 1e-6);
  scenario::Recording ahead = braking(15.0, 5.0);
  for (scenario::Sample& sample : ahead) {
    sample.X_WA.p.x += 60.0;
  }
  const ShadowJudgement the_others = judgement(braking(15.0, 3.9), ahead);
  EXPECT_EQ(the_others.reason, ShadowReason::other_braked);
  EXPECT_NEAR(the_others.other_deceleration, 5.0, 1e-6);
  EXPECT_TRUE(is_danger(his.reason));
  EXPECT_TRUE(is_danger(the_others.reason));
}

/// 15 m/s along x, from 1 s on aside.
scenario::Recording swerving(double lateral) {
  return recorded(
      [=](double t) {
        const double s = std::max(0.0, t - 1.0);
        return Vec2{15.0 * t, 0.5 * lateral * s * s};
      },
      [](double) { return 15.0; });
}

TEST(ShadowJudge, HardSteeringIsDangerAndALaneChangeIsNot) {
  const ShadowJudgement hard = judgement(swerving(3.5), standing(100.0, -8.0));
  EXPECT_EQ(hard.reason, ShadowReason::driver_steered);
  EXPECT_NEAR(hard.driver_lateral_acceleration, 3.5, 0.01);
  // 3.5 m in 5 s by a cosine: at most 3.5 / 2 (pi / 5)^2 = 0.69 m/s^2.
  const ShadowJudgement change = judgement(
      recorded(
          [](double t) {
            return Vec2{15.0 * t,
                        1.75 * (1.0 - std::cos(std::numbers::pi / 5.0 * std::min(t, 5.0)))};
          },
          [](double) { return 15.0; }),
      standing(100.0, -8.0));
  EXPECT_EQ(change.reason, ShadowReason::nothing_needed);
  EXPECT_LT(change.driver_lateral_acceleration, 0.7);
}

/// Crosses the lane at x = 15.15 m beyond where the ego is at 1 s, at 10 m/s: its body is in the
/// ego's way while its centre is within 0.95 + 2.25 = 3.2 m of the lane's, here from 2 to 2.64 s.
scenario::Recording crossing() {
  return recorded(
      [](double t) {
        return Vec2{15.0 + 15.15, 10.0 * (t - 2.32)};
      },
      [](double) { return 10.0; }, std::numbers::pi / 2.0);
}

// The ego's centre may not be from 12 m (0.9 + 2.25 before the other's line) to 18.5 m beyond its
// place at 1 s meanwhile. At 15 m/s it would. With 7 m/s^2 more it is 18.5 m on in a second. To
// stand before, 12 m on at most, takes 15^2 / 24 = 9.4 m/s^2.
TEST(ShadowJudge, WhoSlipsThroughNeededToBrake) {
  const ShadowJudgement told =
      judgement(recorded(
                    [](double t) {
                      const double s = std::max(0.0, t - 1.0);
                      return Vec2{15.0 * t + 0.5 * 7.6 * s * s, 0.0};
                    },
                    [](double t) { return 15.0 + 7.6 * std::max(0.0, t - 1.0); }),
                crossing());
  EXPECT_EQ(told.reason, ShadowReason::braking_needed);
  EXPECT_TRUE(is_danger(told.reason));
  EXPECT_NEAR(told.needed_deceleration.value(), 225.0 / 24.0, 0.15);
  EXPECT_GT(told.least_gap, 0.0);
}

// He was on his way out of the lane, at a constant 2 m/s: nothing was needed of him.
TEST(ShadowJudge, WhoIsLeavingTheLaneNeededNothing) {
  const ShadowJudgement told = judgement(recorded(
                                             [](double t) {
                                               return Vec2{15.0 * t, 2.0 * t};
                                             },
                                             [](double) { return 15.0; }),
                                         standing(15.0 + 19.0 + 4.5, -0.5));
  EXPECT_EQ(told.reason, ShadowReason::nothing_needed);
  EXPECT_EQ(told.needed_deceleration, 0.0);
  EXPECT_NEAR(told.driver_lateral_acceleration, 0.0, 1e-6);
}

TEST(ShadowJudge, BodiesThatTouchAreAnErrorOfTheRecording) {
  const ShadowJudgement told = judgement(braking(15.0, 2.0), standing(15.0 + 20.0));
  EXPECT_EQ(told.reason, ShadowReason::bodies_touch);
  EXPECT_FALSE(is_danger(told.reason));
  EXPECT_EQ(told.least_gap, 0.0);
}

// His front, 2.25 m ahead, is at the other's rear, 32.75 m, after 1 s and the way 15.5 m of
// braking.
TEST(ShadowJudge, ATouchAfterNormalDrivingIsACrash) {
  for (const auto& [until, reason] :
       {std::pair{1.5, ShadowReason::crash}, std::pair{2.5, ShadowReason::bodies_touch}}) {
    const ShadowJudgement told =
        judgement(braking(15.0, 2.0), standing(15.0 + 20.0), 1.0, {.until = until});
    EXPECT_EQ(told.reason, reason);
  }
  EXPECT_TRUE(is_danger(ShadowReason::crash));
}

// Where the other is not recorded nobody touches it; what he needed is told as if it went on.
TEST(ShadowJudge, OnlyWhoIsRecordedIsTouched) {
  const scenario::Recording all = standing(15.0 + 20.0);
  const ShadowJudgement told = judgement(braking(15.0, 2.0), {all.begin(), all.begin() + 16}, 1.0,
                                         {.settling = {.after_start = 0.5, .before_end = 0.5}});
  EXPECT_GT(told.least_gap, 7.0);
  EXPECT_EQ(told.reason, ShadowReason::braking_needed);
}

// Recorded from 1 s before the trigger on, or until 1 s after it.
TEST(ShadowJudge, WhoWasOnlyJustRecordedIsTold) {
  const auto reason = [](std::ptrdiff_t first, std::ptrdiff_t last, double time) {
    const scenario::Recording all = standing(300.0);
    return judgement(braking(15.0, 2.0), {all.begin() + first, all.begin() + last + 1}, time)
        .reason;
  };
  EXPECT_EQ(reason(10, 60, 2.0), ShadowReason::track_ends);
  EXPECT_EQ(reason(10, 60, 2.8), ShadowReason::nothing_needed);
  EXPECT_EQ(reason(0, 60, 1.0), ShadowReason::nothing_needed);
  EXPECT_EQ(reason(0, 30, 2.0), ShadowReason::track_ends);
  EXPECT_FALSE(is_danger(ShadowReason::track_ends));
}

TEST(ShadowJudge, EveryReasonHasItsName) {
  for (const ShadowReason reason :
       {ShadowReason::track_ends, ShadowReason::driver_braked, ShadowReason::other_braked,
        ShadowReason::driver_steered, ShadowReason::bodies_touch, ShadowReason::braking_needed,
        ShadowReason::nothing_needed}) {
    EXPECT_EQ(shadow_reason_from(name(reason)), reason);
    EXPECT_FALSE(meaning(reason).empty());
  }
  EXPECT_EQ(shadow_reason_from("braked"), std::nullopt);
}

TEST(ShadowJudge, WantsARecordedEgo) {
  scenario::Scenario scenario;
  scenario.actors.push_back({.footprint = {.length = 4.5, .width = 1.8}, .motion = standing(9.0)});
  EXPECT_THROW((void)judged(scenario, scenario::standard_ego, 0, 1.0), ContractViolation);
  scenario.ego = standing(0.0);
  EXPECT_THROW((void)judged(scenario, scenario::standard_ego, 1, 1.0), ContractViolation);
  EXPECT_THROW((void)actor_index(scenario, {.id = 7}), ContractViolation);
}

}  // namespace
}  // namespace saca::eval::shadow_judge_test

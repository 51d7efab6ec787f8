#include "saca/onboard/manoeuvre/drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "tests/support/scenes.h"

namespace saca::manoeuvre::drive_test {
namespace {

using testing::HasSubstr;

const Car& car() {
  static const Car the_car = prepare::default_car();
  return the_car;
}

world::Scene scene_at(double speed, double grip) {
  world::Scene scene = test::ego_alone(speed, grip);
  scene.time = 7.0;
  return scene;
}

world::LanePose end_of(const EgoMotion& motion, const world::Scene& scene) {
  return world::to_lane(scene.road, motion.track.X_WA.back());
}

double largest_sideslip(const EgoMotion& motion) {
  double largest = 0.0;
  for (const Vec2& v_B : motion.v_B) {
    if (v_B.x > 3.0) {
      largest = std::max(largest, std::abs(std::atan2(v_B.y, v_B.x)));
    }
  }
  return largest;
}

TEST(Drive, StopsInItsLane) {
  const world::Scene scene = scene_at(14.0, 0.9);
  const EgoMotion motion = drive(car(), {PolicyId::aeb, {}}, scene, 0.9, 6.0);
  EXPECT_TRUE(motion.ended);
  EXPECT_EQ(motion.v_B.back().x, 0.0);
  EXPECT_NEAR(end_of(motion, scene).d, 0.0, 1e-6);
  EXPECT_EQ(motion.track.start, 7.0);
  EXPECT_EQ(motion.track.step, 0.01);
  EXPECT_EQ(motion.v_B.size(), motion.track.X_WA.size());
  EXPECT_EQ(motion.yaw_rate.size(), motion.track.X_WA.size());
}

Plan braking_at(double strength) {
  return {.policy = PolicyId::aeb, .strength = strength};
}

double air_per_mass() {  // deceleration over v^2 [1/m]
  return 0.5 * vehicle::air_density * car().drag_area / car().mass;
}

// A deceleration a that builds up over a lag T after a dead time D stops from v within
// v (D + T) + ln(1 + k v^2 / a) / (2 k), where the air slows by k v^2; without it the latter is
// v^2 / (2 a). While the load moves to the front the brakes give a little less.
TEST(Drive, StopsByAStrengthAsAConstantDecelerationDoes) {
  for (const double grip : {0.4, 0.9}) {
    for (const double strength : {0.2, 0.3, 0.45, 0.6, 0.8}) {
      for (const double speed : {8.0, 14.0, 25.0}) {
        const world::Scene scene = scene_at(speed, grip);
        const EgoMotion motion = drive(car(), braking_at(strength), scene, grip, 60.0);
        const double a = strength * grip * vehicle::gravity;
        const double k = air_per_mass();
        const double way = speed * (car().brake_dead_time + car().brake_lag) +
                           std::log1p(k * speed * speed / a) / (2.0 * k);
        const double driven = motion.track.X_WA.back().p.x - motion.track.X_WA.front().p.x;
        EXPECT_TRUE(motion.ended) << strength;
        EXPECT_EQ(motion.v_B.back().x, 0.0);
        EXPECT_GT(driven, 0.98 * way) << strength << " on " << grip << " from " << speed;
        EXPECT_LT(driven, 1.03 * way) << strength << " on " << grip << " from " << speed;
        EXPECT_NEAR(end_of(motion, scene).d, 0.0, 1e-6);
      }
    }
  }
}

// Between a fifth and four fifths of the speed nothing builds up or fades any more: what is asked
// for, and at most what the air adds at 25 m/s.
TEST(Drive, DeceleratesByWhatTheStrengthAsks) {
  for (const double strength : {0.2, 0.45, 0.8}) {
    const double speed = 25.0;
    const EgoMotion motion = drive(car(), braking_at(strength), scene_at(speed, 0.8), 0.8, 60.0);
    const auto first_below = [&](double share) {
      return static_cast<double>(std::find_if(motion.v_B.begin(), motion.v_B.end(),
                                              [&](Vec2 v_B) { return v_B.x < share * speed; }) -
                                 motion.v_B.begin()) *
             motion.track.step;
    };
    const double mean = 0.6 * speed / (first_below(0.2) - first_below(0.8));
    const double asked = strength * 0.8 * vehicle::gravity;
    const double air = air_per_mass() * speed * speed;
    EXPECT_GT(mean, 0.98 * asked) << strength;
    EXPECT_LT(mean, 1.02 * asked + air) << strength;
  }
}

TEST(Drive, HarderIsNeverLonger) {
  for (const double grip : {0.3, 0.6, 1.0}) {
    double last = std::numeric_limits<double>::infinity();
    for (const double strength : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
      const world::Scene scene = scene_at(15.0, grip);
      const EgoMotion motion = drive(car(), braking_at(strength), scene, grip, 60.0);
      const double way = motion.track.X_WA.back().p.x;
      EXPECT_LT(way, last) << strength << " on " << grip;
      last = way;
    }
  }
}

TEST(Drive, AllOfTheGripIsFullBrakingBitByBit) {
  for (const double curvature : {0.0, 0.01}) {
    world::Scene scene = scene_at(14.0, 0.7);
    scene.road.curvature = curvature;
    scene.ego.yaw_rate = curvature * 14.0;
    const EgoMotion full = drive(car(), full_braking, scene, 0.66, 9.0);
    const EgoMotion all = drive(car(), braking_at(1.0), scene, 0.66, 9.0);
    ASSERT_EQ(full.v_B.size(), all.v_B.size());
    EXPECT_EQ(std::memcmp(full.track.X_WA.data(), all.track.X_WA.data(),
                          full.track.X_WA.size() * sizeof(Pose)),
              0);
  }
}

// The bend asks for three quarters of the grip: the brakes may have a share of 0.66 of it, and a
// strength below that asks for no more than itself.
TEST(Drive, BrakesByAStrengthInABendAndKeepsItsLane) {
  world::Scene scene = scene_at(15.0, 0.8);
  scene.road.curvature = 0.75 * 0.8 * vehicle::gravity / (15.0 * 15.0);
  scene.ego.yaw_rate = scene.road.curvature * 15.0;
  scene.ego.a_B = {0.0, scene.road.curvature * 15.0 * 15.0};
  const EgoMotion gentle = drive(car(), braking_at(0.3), scene, 0.8, 20.0);
  const EgoMotion hard = drive(car(), full_braking, scene, 0.8, 20.0);
  EXPECT_TRUE(gentle.ended);
  EXPECT_GT(gentle.v_B.size(), hard.v_B.size());
  EXPECT_NEAR(end_of(gentle, scene).d, 0.0, 0.3);
}

// A lane change ends one lane width from the road, in its direction, and never overshoots by a
// quarter of a metre; with braking it also ends at the speed that was asked for.
TEST(Drive, ChangesLaneAndRecoversItsDirectionEverywhereInTheDomain) {
  for (const double grip : {0.3, 0.9}) {
    for (const double speed : {5.0, 10.0, 16.0, 25.0}) {
      for (const PolicyId policy : {PolicyId::aes_left, PolicyId::es_b_right}) {
        const world::Scene scene = scene_at(speed, grip);
        const EgoMotion motion = drive(car(), default_plan(policy, speed), scene, grip, 9.0);
        const double side = policy == PolicyId::aes_left ? 1.0 : -1.0;
        const world::LanePose end = end_of(motion, scene);
        EXPECT_TRUE(motion.ended) << speed << " " << grip;
        EXPECT_NEAR(end.d, side * 3.5, 0.2) << speed << " " << grip;
        EXPECT_NEAR(end.heading, 0.0, from_degrees(2.0)) << speed << " " << grip;
        EXPECT_NEAR(motion.v_B.back().x, policy == PolicyId::aes_left ? speed : speed / 2.0, 1.0);
        for (const Pose& X_WB : motion.track.X_WA) {
          EXPECT_LT(side * X_WB.p.y, 3.75) << speed << " " << grip;
          EXPECT_GT(side * X_WB.p.y, -0.1) << speed << " " << grip;
        }
      }
    }
  }
}

// "No high slip": the sideslip of a normal turn, v_y / v_x = l_r / radius less the tyres' slip, is
// about 10 degrees at the steering's limit; more would be sliding.
TEST(Drive, DoesNotSlide) {
  for (const double grip : {0.3, 0.9}) {
    for (const double speed : {8.0, 14.0, 25.0}) {
      const world::Scene scene = scene_at(speed, grip);
      for (const PolicyId policy : {PolicyId::aes_left, PolicyId::es_b_left}) {
        const EgoMotion motion = drive(car(), default_plan(policy, speed), scene, grip, 6.0);
        EXPECT_LT(largest_sideslip(motion), from_degrees(12.0)) << speed << " " << grip;
      }
    }
  }
}

TEST(Drive, ForgivesAGripThatIsWrongBySixPercent) {
  for (const double factor : {0.94, 1.06}) {
    for (const double grip : {0.35, 0.9}) {
      for (const double speed : {8.0, 25.0}) {
        for (const PolicyId policy : {PolicyId::aes_right, PolicyId::es_b_left}) {
          const world::Scene scene = scene_at(speed, grip);
          const EgoMotion motion =
              drive(car(), default_plan(policy, speed), scene, factor * grip, 9.0);
          EXPECT_TRUE(motion.ended) << factor << " " << grip << " " << speed;
          EXPECT_LT(largest_sideslip(motion), from_degrees(12.0)) << factor << " " << grip;
        }
      }
    }
  }
}

TEST(Drive, StartsFromAWrongDirectionToo) {
  world::Scene scene = scene_at(14.0, 0.8);
  scene.ego.X_WB = {{0.0, -0.3}, from_degrees(2.5)};
  scene.ego.yaw_rate = -0.08;
  scene.ego.a_B = {-2.0, -1.1};
  for (const PolicyId policy : {PolicyId::aes_left, PolicyId::aes_right, PolicyId::es_b_left}) {
    const EgoMotion motion = drive(car(), default_plan(policy, 14.0), scene, 0.8, 6.0);
    EXPECT_TRUE(motion.ended);
    EXPECT_NEAR(std::abs(end_of(motion, scene).d), 3.5, 0.2);
  }
  const EgoMotion stopped = drive(car(), {PolicyId::aeb, {}}, scene, 0.8, 6.0);
  EXPECT_NEAR(end_of(stopped, scene).heading, 0.0, from_degrees(2.0));
  EXPECT_LT(std::abs(end_of(stopped, scene).d), 0.6);
}

TEST(Drive, FollowsABend) {
  world::Scene scene = scene_at(14.0, 0.9);
  scene.road.curvature = 0.01;  // radius 100 m: 2 m/s^2
  scene.ego.yaw_rate = 0.14;
  scene.ego.a_B.y = 1.96;
  const EgoMotion kept = drive(car(), {PolicyId::no_intervention, {}}, scene, 0.9, 5.0);
  EXPECT_FALSE(kept.ended);  // the horizon came first
  EXPECT_NEAR(end_of(kept, scene).d, 0.0, 0.2);
  EXPECT_NEAR(kept.v_B.back().x, 14.0, 0.2);
  const EgoMotion changed = drive(car(), {PolicyId::aes_left, {}}, scene, 0.9, 5.0);
  EXPECT_TRUE(changed.ended);
  EXPECT_NEAR(end_of(changed, scene).d, 3.5, 0.2);
}

TEST(Drive, NoInterventionKeepsOffsetAndSpeed) {
  world::Scene scene = scene_at(20.0, 0.9);
  scene.ego.X_WB.p.y = 0.6;
  const EgoMotion motion = drive(car(), {PolicyId::no_intervention, {}}, scene, 0.9, 3.0);
  EXPECT_NEAR(end_of(motion, scene).d, 0.6, 0.01);
  EXPECT_NEAR(end_of(motion, scene).s, 60.0, 0.2);
}

TEST(Drive, RestStaysRest) {
  const world::Scene scene = scene_at(0.0, 0.9);
  const EgoMotion motion = drive(car(), {PolicyId::no_intervention, {}}, scene, 0.9, 1.0);
  EXPECT_EQ(motion.track.X_WA.back().p.x, 0.0);
  EXPECT_TRUE(drive(car(), {PolicyId::aeb, {}}, scene, 0.9, 1.0).ended);
}

TEST(Drive, BrakesToAStopWhileItChangesLane) {
  const world::Scene scene = scene_at(16.0, 0.9);
  const EgoMotion motion = drive(car(), {PolicyId::es_b_left, 0.0}, scene, 0.9, 9.0);
  EXPECT_TRUE(motion.ended);
  EXPECT_EQ(motion.v_B.back().x, 0.0);
  EXPECT_NEAR(end_of(motion, scene).d, 3.5, 0.4);
}

TEST(Drive, LeftIsTheMirrorOfRight) {
  const world::Scene scene = scene_at(15.0, 0.7);
  for (const auto& [left, right] : {std::pair{PolicyId::aes_left, PolicyId::aes_right},
                                    std::pair{PolicyId::es_b_left, PolicyId::es_b_right}}) {
    const EgoMotion a = drive(car(), default_plan(left, 15.0), scene, 0.7, 5.0);
    const EgoMotion b = drive(car(), default_plan(right, 15.0), scene, 0.7, 5.0);
    ASSERT_EQ(a.track.X_WA.size(), b.track.X_WA.size());
    EXPECT_NEAR(a.track.X_WA.back().p.x, b.track.X_WA.back().p.x, 1e-6);
    EXPECT_NEAR(a.track.X_WA.back().p.y, -b.track.X_WA.back().p.y, 1e-6);
  }
}

TEST(Drive, TheWorldMayBeTurned) {
  const world::Scene scene = scene_at(15.0, 0.7);
  const Pose X_VW{{-40.0, 12.0}, std::numbers::pi / 2.0};
  world::Scene turned = scene;
  turned.ego.X_WB = X_VW * scene.ego.X_WB;
  turned.road.X_WL = X_VW * scene.road.X_WL;
  const EgoMotion a = drive(car(), {PolicyId::aes_left, {}}, scene, 0.7, 5.0);
  const EgoMotion b = drive(car(), {PolicyId::aes_left, {}}, turned, 0.7, 5.0);
  ASSERT_EQ(a.track.X_WA.size(), b.track.X_WA.size());
  const Pose expected = X_VW * a.track.X_WA.back();
  EXPECT_NEAR(b.track.X_WA.back().p.x, expected.p.x, 1e-6);
  EXPECT_NEAR(b.track.X_WA.back().p.y, expected.p.y, 1e-6);
}

TEST(Drive, SameInputSameBytes) {
  const world::Scene scene = scene_at(18.0, 0.6);
  const EgoMotion a = drive(car(), default_plan(PolicyId::es_b_left, 18.0), scene, 0.6, 4.0);
  const EgoMotion b = drive(car(), default_plan(PolicyId::es_b_left, 18.0), scene, 0.6, 4.0);
  ASSERT_EQ(a.v_B.size(), b.v_B.size());
  EXPECT_EQ(std::memcmp(a.v_B.data(), b.v_B.data(), a.v_B.size() * sizeof(Vec2)), 0);
  EXPECT_EQ(
      std::memcmp(a.track.X_WA.data(), b.track.X_WA.data(), a.track.X_WA.size() * sizeof(Pose)), 0);
}

TEST(Refusal, NamesWhatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto why = [](const Plan& plan, double speed, double grip) {
    return refusal(car(), plan, scene_at(speed, grip)).value_or("none");
  };
  const Plan swerve{PolicyId::aes_left, {}};
  EXPECT_EQ(why(swerve, 14.0, 0.9), "none");
  const double slowest = drift_speeds(car().tuning.domain, 0.9).slowest;
  EXPECT_EQ(why({PolicyId::t_drift_left, {}}, slowest, 0.9), "none");
  EXPECT_THAT(why({PolicyId::t_drift_left, {}}, slowest - 0.1, 0.9),
              HasSubstr("to 25 m/s ahead, is"));
  EXPECT_THAT(why({PolicyId::t_drift_right, {}}, 14.0, 0.19), HasSubstr("T-D-R"));
  EXPECT_THAT(why(swerve, 4.9, 0.9), HasSubstr("5 to 25 m/s"));
  EXPECT_THAT(why(swerve, 25.1, 0.9), HasSubstr("25.10"));
  EXPECT_THAT(why(swerve, nan, 0.9), HasSubstr("not finite"));
  EXPECT_THAT(why(swerve, 14.0, 0.19), HasSubstr("0.190"));
  EXPECT_THAT(why(swerve, 14.0, nan), HasSubstr("grip"));
  EXPECT_THAT(why({PolicyId::es_b_left, {}}, 14.0, 0.9), HasSubstr("needs a target speed"));
  EXPECT_THAT(why({PolicyId::es_b_left, nan}, 14.0, 0.9), HasSubstr("target speed"));
  EXPECT_THAT(why({PolicyId::aeb, 3.0}, 14.0, 0.9), HasSubstr("no target speed"));
  for (const double strength : {0.19, 1.01, nan, -0.5}) {
    EXPECT_THAT(why(braking_at(strength), 14.0, 0.9), HasSubstr("strength must be 0.2 to 1"));
  }
  EXPECT_THAT(why({PolicyId::no_intervention, {}, 0.5}, 14.0, 0.9), HasSubstr("takes no strength"));
  EXPECT_THAT(why({PolicyId::es_b_left, 7.0, 0.5}, 14.0, 0.9), HasSubstr("takes no strength"));
  EXPECT_THAT(why({static_cast<PolicyId>(9), {}}, 14.0, 0.9), HasSubstr("no such policy"));
  EXPECT_EQ(why({PolicyId::aeb, {}}, 0.0, 0.3), "none");
}

// Never without a plan: the fallback exists at any speed and on any grip.
TEST(Refusal, NeverOfBraking) {
  for (const double speed : {-3.0, 0.0, 3.0, 40.0}) {
    for (const double grip : {0.1, 1.2}) {
      const world::Scene scene = scene_at(speed, grip);
      ASSERT_EQ(refusal(car(), {PolicyId::aeb, {}}, scene), std::nullopt);
      const EgoMotion motion = drive(car(), {PolicyId::aeb, {}}, scene, grip, 60.0);
      EXPECT_TRUE(motion.ended) << speed << " m/s, grip " << grip;
      EXPECT_LT(std::abs(motion.v_B.back().x), 0.1);
    }
  }
}

TEST(Refusal, OfADriftWhereNoSpeedWillDo) {
  Car weak = car();
  weak.tuning.domain.fastest.front() = 0.0;
  EXPECT_THAT(refusal(weak, {PolicyId::t_drift_left, {}}, scene_at(20.0, 0.2)).value_or("none"),
              HasSubstr("not possible at a grip of 0.20"));
}

TEST(Refusal, OfALaneChangeInATightBend) {
  world::Scene scene = scene_at(20.0, 0.5);
  scene.road.curvature = -0.01;  // 4 m/s^2 of 4.9
  EXPECT_THAT(refusal(car(), {PolicyId::aes_left, {}}, scene).value_or("none"), HasSubstr("82 %"));
  EXPECT_EQ(refusal(car(), {PolicyId::aeb, {}}, scene), std::nullopt);
  scene.road.curvature = -0.0049;  // 2 m/s^2 of 4.9: enough for a lane change, too much for a drift
  EXPECT_EQ(refusal(car(), {PolicyId::aes_left, {}}, scene), std::nullopt);
  EXPECT_THAT(refusal(car(), {PolicyId::t_drift_left, {}}, scene).value_or("none"),
              HasSubstr("allows a bend 30 % of the grip, this one takes 40 %"));
}

// At 25 m/s this car's lane changes give up 0.42 of the grip, a bend that takes 0.45 leaves nothing
// of 0.76.
TEST(Refusal, OfALaneChangeForWhichSpeedAndBendLeaveNoGrip) {
  Car fast = car();
  fast.tuning.swerve.fast_less = 0.06;
  fast.tuning.swerve.braked_share = 0.76;
  world::Scene scene = scene_at(25.0, 0.9);
  scene.road.curvature = 0.45 * 0.9 * vehicle::gravity / (25.0 * 25.0);
  EXPECT_THAT(refusal(fast, {PolicyId::es_b_left, 12.5}, scene).value_or("none"),
              HasSubstr("needs 5 % of the grip, this bend and speed leave 0 %"));
  scene.road.curvature *= 0.5;  // 0.76 - 0.42 - 0.225
  EXPECT_EQ(refusal(fast, {PolicyId::es_b_left, 12.5}, scene), std::nullopt);
}

TEST(Drive, RefusesWhatCannotBeDriven) {
  EXPECT_THROW((void)drive(car(), {PolicyId::t_drift_left, {}}, scene_at(9.0, 0.9), 0.9, 5.0),
               ContractViolation);
  EXPECT_THROW((void)drive(car(), {PolicyId::aeb, {}}, scene_at(14.0, 0.9), 0.0, 5.0),
               ContractViolation);
}

}  // namespace
}  // namespace saca::manoeuvre::drive_test

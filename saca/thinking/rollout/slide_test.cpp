#include "saca/thinking/rollout/slide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::rollout::slide_test {
namespace {

using manoeuvre::EgoMotion;

constexpr double g = vehicle::gravity;
constexpr world::Footprint sedan{.length = 4.7, .width = 1.9};

collision::ImpactBody sliding_body(Vec2 v_W, double yaw_rate,
                                   const world::Footprint& footprint = sedan) {
  collision::ImpactBody body = collision::free_body(1700.0, footprint);
  body.v_W = v_W;
  body.yaw_rate = yaw_rate;
  return body;
}

double lasts(const EgoMotion& motion) {
  return world::end_time(motion.track) - motion.track.start;
}

// Speeds end a pose's step after the rest, and rest begins below 0.05 m/s.
TEST(Slide, WithoutSpinTakesVSquaredOverTwoMuG) {
  for (const double grip : {0.2, 0.9}) {
    const Vec2 v_W = rotated({12.0, 0.0}, 0.7);
    const EgoMotion motion = slide(sedan, sliding_body(v_W, 0.0), {{3.0, -2.0}, 0.2}, 5.0, grip);
    const Vec2 way = motion.track.X_WA.back().p - Vec2{3.0, -2.0};
    EXPECT_NEAR(norm(way), 144.0 / (2.0 * grip * g), 1e-3);
    EXPECT_NEAR(std::atan2(way.y, way.x), 0.7, 1e-9);
    EXPECT_NEAR(motion.track.X_WA.back().yaw, 0.2, 1e-9);
    EXPECT_NEAR(lasts(motion), 12.0 / (grip * g), 0.05 / (grip * g) + 0.01);
    EXPECT_EQ(motion.track.start, 5.0);
    EXPECT_TRUE(motion.ended);
    EXPECT_EQ(norm(motion.v_B.back()), 0.0);
  }
}

// All wheels at the radius r: the spin falls by mu g r m / I.
TEST(Slide, WithoutSpeedStopsTurningInClosedForm) {
  const double grip = 0.8;
  const double r = std::hypot(0.3 * 4.7, 0.4 * 1.9);
  const double fall = grip * g * r / ((4.7 * 4.7 + 1.9 * 1.9) / 12.0);
  const EgoMotion motion = slide(sedan, sliding_body({}, -4.0), {}, 0.0, grip);
  EXPECT_NEAR(motion.track.X_WA.back().yaw, -16.0 / (2.0 * fall), 1e-3);
  EXPECT_NEAR(lasts(motion), 4.0 / fall, 0.05 / r / fall + 0.01);
  EXPECT_LT(norm(motion.track.X_WA.back().p), 1e-12);
}

TEST(Slide, ABodyAtRestOrWithoutMassStays) {
  EXPECT_EQ(slide(sedan, sliding_body({}, 0.0), {{1.0, 2.0}, 0.3}, 0.0, 0.9).track.X_WA.size(), 1U);
  collision::ImpactBody ground;
  EXPECT_EQ(slide(sedan, ground, {}, 0.0, 0.9).track.X_WA.size(), 1U);
}

double kinetic_energy(const EgoMotion& motion, std::size_t i) {
  const double inertia = (4.7 * 4.7 + 1.9 * 1.9) / 12.0;
  return 0.5 * dot(motion.v_B[i], motion.v_B[i]) +
         0.5 * inertia * motion.yaw_rate[i] * motion.yaw_rate[i];
}

struct Thrown {
  Vec2 v_W;
  double yaw_rate;
  Pose X_WB;
  double grip;
};

Thrown thrown(std::mt19937& rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return {{20.0 * uniform(rng), 20.0 * uniform(rng)},
          6.0 * uniform(rng),
          {{10.0 * uniform(rng), 10.0 * uniform(rng)}, 3.0 * uniform(rng)},
          0.6 + 0.4 * uniform(rng)};
}

EgoMotion slid(const Thrown& t, const SlideSteps& steps = {}) {
  return slide(sedan, sliding_body(t.v_W, t.yaw_rate), t.X_WB, 0.0, t.grip, steps);
}

TEST(Slide, OnlyLosesEnergyAndSpinMakesItLonger) {
  std::mt19937 rng(1);
  for (int i = 0; i < 50; ++i) {
    const Thrown t = thrown(rng);
    const EgoMotion motion = slid(t);
    for (std::size_t k = 1; k < motion.v_B.size(); ++k) {
      ASSERT_LT(kinetic_energy(motion, k), kinetic_energy(motion, k - 1)) << i;
    }
    const double straight = dot(t.v_W, t.v_W) / (2.0 * t.grip * g);
    EXPECT_GT(norm(motion.track.X_WA.back().p - t.X_WB.p), straight * 0.98 - 1e-3) << i;
    // No faster than all wheels pulling one way can stop it.
    EXPECT_GE(lasts(motion), (norm(t.v_W) - 0.05) / (t.grip * g)) << i;
  }
}

TEST(Slide, IsTheSameTurnedAndMirrored) {
  std::mt19937 rng(2);
  const Pose X_VW{{300.0, -200.0}, 2.3};
  for (int i = 0; i < 50; ++i) {
    const Thrown t = thrown(rng);
    const EgoMotion original = slid(t);
    const EgoMotion turned = slid({rotated(t.v_W, X_VW.yaw), t.yaw_rate, X_VW * t.X_WB, t.grip});
    const EgoMotion flipped =
        slid({{t.v_W.x, -t.v_W.y}, -t.yaw_rate, {{t.X_WB.p.x, -t.X_WB.p.y}, -t.X_WB.yaw}, t.grip});
    ASSERT_EQ(original.v_B.size(), turned.v_B.size());
    ASSERT_EQ(original.v_B.size(), flipped.v_B.size());
    const Pose end = original.track.X_WA.back();
    EXPECT_LT(norm(X_VW * end.p - turned.track.X_WA.back().p), 1e-8);
    EXPECT_NEAR(wrap_angle(end.yaw + X_VW.yaw - turned.track.X_WA.back().yaw), 0.0, 1e-8);
    EXPECT_NEAR(end.p.y, -flipped.track.X_WA.back().p.y, 1e-9);
    EXPECT_NEAR(wrap_angle(end.yaw + flipped.track.X_WA.back().yaw), 0.0, 1e-9);
  }
}

// Against steps a fiftieth as long. A wheel that stands still for a moment has a force that turns
// round at once, which costs the order, not the answer.
TEST(Slide, ShorterStepsChangeLittle) {
  std::mt19937 rng(3);
  for (int i = 0; i < 30; ++i) {
    const Thrown t = thrown(rng);
    const Pose fine = slid(t, {.per_pose = 100}).track.X_WA.back();
    const Pose usual = slid(t).track.X_WA.back();
    const Pose twice = slid(t, {.per_pose = 4}).track.X_WA.back();
    EXPECT_LT(norm(usual.p - fine.p), 2e-3) << i;
    EXPECT_LT(std::abs(wrap_angle(usual.yaw - fine.yaw)), 2e-3) << i;
    EXPECT_LT(norm(twice.p - fine.p), 1e-3) << i;
    const Pose coarse = slid(t, coarse_slide).track.X_WA.back();
    EXPECT_LT(norm(coarse.p - fine.p), 0.06) << i;
    EXPECT_LT(std::abs(wrap_angle(coarse.yaw - fine.yaw)), 0.03) << i;
  }
}

// Somebody on foot who is struck at the shoulder spins tens of times a second: a step of a forecast
// turns by radians. Nothing is gained by that, and it ends where shorter steps have it.
TEST(Slide, OfWhoSpinsFastIsWorkedOutInParts) {
  const world::Footprint walker{.shape = world::Shape::ellipse, .length = 0.5, .width = 0.6};
  for (const double spin : {30.0, -80.0, 150.0, -400.0}) {
    collision::ImpactBody body = collision::free_body(75.0, walker);
    body.v_W = {12.0, 3.0};
    body.yaw_rate = spin;
    const EgoMotion coarse = slide(walker, body, {}, 0.0, 0.8, coarse_slide);
    const EgoMotion fine = slide(walker, body, {}, 0.0, 0.8, {.per_pose = 100});
    for (std::size_t k = 1; k < coarse.v_B.size(); ++k) {
      ASSERT_TRUE(is_finite(coarse.track.X_WA[k]));
      ASSERT_LE(norm(coarse.v_B[k]), norm(coarse.v_B[k - 1]) + 1e-6) << spin;
      ASSERT_LE(std::abs(coarse.yaw_rate[k]), std::abs(coarse.yaw_rate[k - 1]) + 1e-6) << spin;
    }
    const double tolerance = std::abs(spin) < 200.0 ? 0.06 : 1.0;  // [m]; 64 turns a second
    EXPECT_LT(norm(coarse.track.X_WA.back().p - fine.track.X_WA.back().p), tolerance) << spin;
  }
}

// Poses and velocities belong together: the way between two poses is the mean velocity's.
TEST(Slide, VelocitiesAreThoseOfThePoses) {
  std::mt19937 rng(4);
  const EgoMotion motion = slid(thrown(rng));
  for (std::size_t k = 0; k + 2 < motion.v_B.size(); ++k) {
    const Pose& from = motion.track.X_WA[k];
    const Pose& to = motion.track.X_WA[k + 1];
    const Vec2 mean = 0.5 * (rotated(motion.v_B[k], from.yaw) + rotated(motion.v_B[k + 1], to.yaw));
    EXPECT_LT(norm(to.p - from.p - 0.01 * mean), 1e-4);
    EXPECT_NEAR(wrap_angle(to.yaw - from.yaw),
                0.005 * (motion.yaw_rate[k] + motion.yaw_rate[k + 1]), 1e-4);
  }
}

TEST(Slide, RefusesWhatIsNoMotion) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)slide(sedan, sliding_body({nan, 0.0}, 0.0), {}, 0.0, 0.9), ContractViolation);
  EXPECT_THROW((void)slide(sedan, sliding_body({}, nan), {}, 0.0, 0.9), ContractViolation);
  EXPECT_THROW((void)slide(sedan, sliding_body({}, 1.0), {}, nan, 0.9), ContractViolation);
  EXPECT_THROW((void)slide(sedan, sliding_body({}, 1.0), {}, 0.0, 0.0), ContractViolation);
  EXPECT_THROW((void)slide(sedan, sliding_body({}, 1.0), {}, 0.0, 0.9, {.per_pose = 0}),
               ContractViolation);
  EXPECT_THROW((void)slide(sedan, sliding_body({}, 1.0), {}, 0.0, 0.9, {.pose = 0.06}),
               ContractViolation);
  EXPECT_THROW((void)slide({.length = 0.0, .width = 1.0}, sliding_body({}, 1.0), {}, 0.0, 0.9),
               ContractViolation);
}

}  // namespace
}  // namespace saca::rollout::slide_test

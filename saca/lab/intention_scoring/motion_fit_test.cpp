#include "saca/lab/intention_scoring/motion_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequence.h"

namespace saca::intention_scoring::motion_fit_test {
namespace {

TrueMotion still(std::size_t size) {
  return {std::vector<double>(size, 0.0), std::vector<double>(size, 0.0),
          std::vector<double>(size, 0.0), 3.5};
}

TEST(LogNormal, FindsWhatWasDrawn) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> drawn(std::log(3.0), 0.4);
  std::vector<double> values(5'000);
  for (double& each : values) {
    each = drawn(random);
  }
  const LogNormal fit = log_normal(values);
  EXPECT_NEAR(fit.median, 3.0, 0.06);  // sampling: 3 x 0.4 x 1.25 / sqrt(5000) = 0.02
  EXPECT_NEAR(fit.log_sd, 0.4, 0.02);
  EXPECT_EQ(log_normal({2.0}).log_sd, 0.0);
  EXPECT_THROW((void)log_normal({1.0, -1.0}), ContractViolation);
}

TEST(MotionFit, MeasuresBraking) {
  std::vector<TrueMotion> motions;
  for (const double deceleration : {3.0, 4.0, 5.0}) {
    TrueMotion motion = still(100);
    for (std::size_t i = 30; i < 60; ++i) {  // builds up within 0.8 s, then holds
      motion.acceleration[i] = -deceleration * std::min(1.0, static_cast<double>(i - 30) / 8.0);
    }
    motions.push_back(motion);
  }
  const MotionFit fit = motion_fit(motions, 3.5);
  EXPECT_EQ(fit.braking.num, 3U);
  EXPECT_NEAR(fit.braking.median, 4.0, 0.2);  // a few frames of it are still building up
  EXPECT_NEAR(fit.rise.median, 0.8, 0.21);    // frames
  EXPECT_NEAR(fit.held.median, 1.0, 0.1);
  EXPECT_EQ(fit.lane_change.num, 0U);
}

TEST(MotionFit, MeasuresLaneChanges) {
  TrueMotion motion = still(120);
  for (std::size_t i = 20; i <= 70; ++i) {  // 5 s, 3.5 m
    const double x = static_cast<double>(i - 20) / 50.0;
    motion.lateral_speed[i] = 3.5 / 5.0 * 30.0 * x * x * (1.0 - x) * (1.0 - x);
  }
  for (std::size_t i = 1; i < 120; ++i) {
    motion.lateral[i] = motion.lateral[i - 1] + 0.1 * motion.lateral_speed[i];
  }
  const MotionFit fit = motion_fit({motion, motion}, 3.5);
  EXPECT_EQ(fit.lane_change.num, 2U);
  EXPECT_NEAR(fit.lane_change.median, 5.0, 1e-9);
}

TEST(MotionFit, MeasuresHowThoseWaverWhoMaintain) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<TrueMotion> motions;
  const double kept = std::exp(-frame_step / 0.8);
  for (int k = 0; k < 20; ++k) {
    TrueMotion motion = still(1'000);
    double now = 0.3 * normal(random);
    for (double& each : motion.acceleration) {
      each = now;
      now = kept * now + 0.3 * std::sqrt(1.0 - kept * kept) * normal(random);
    }
    motions.push_back(motion);
  }
  const MotionFit fit = motion_fit(motions, 3.5);
  EXPECT_NEAR(fit.acceleration.sd, 0.3, 0.02);
  EXPECT_NEAR(fit.acceleration.time, 0.8, 0.15);
}

TEST(MotionFit, OfNothingIsNothing) {
  const MotionFit fit = motion_fit({}, 3.5);
  EXPECT_EQ(fit.braking.num, 0U);
  EXPECT_EQ(fit.acceleration.sd, 0.0);
}

}  // namespace
}  // namespace saca::intention_scoring::motion_fit_test

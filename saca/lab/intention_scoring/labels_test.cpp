#include "saca/lab/intention_scoring/labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_scoring::labels_test {
namespace {

using intent::Intention;

constexpr std::size_t size = 120;  // frames: 12 s

TrueMotion steady() {
  return {std::vector<double>(size, 0.0), std::vector<double>(size, 0.0),
          std::vector<double>(size, 0.0), 3.5};
}

/// Adds a lateral way with the speed of a half sine: at rest aside before and after.
void add_move(TrueMotion& motion, double way, double begin, double duration) {
  for (std::size_t i = 0; i < size; ++i) {
    const double share =
        std::clamp((static_cast<double>(i) * frame_step - begin) / duration, 0.0, 1.0);
    motion.lateral[i] += way * 0.5 * (1.0 - std::cos(std::numbers::pi * share));
    motion.lateral_speed[i] +=
        way * 0.5 * std::numbers::pi / duration * std::sin(std::numbers::pi * share);
  }
}

void add_braking(TrueMotion& motion, double acceleration, std::size_t first, std::size_t last) {
  std::fill(motion.acceleration.begin() + static_cast<std::ptrdiff_t>(first),
            motion.acceleration.begin() + static_cast<std::ptrdiff_t>(last), acceleration);
}

std::size_t count(const Labels& labels, Intention intention) {
  return static_cast<std::size_t>(std::count(labels.classes.begin(), labels.classes.end(),
                                             static_cast<std::uint8_t>(intention)));
}

TEST(Labels, ALaneChangeLastsAsLongAsItsLateralMotion) {
  TrueMotion motion = steady();
  add_move(motion, 3.5, 3.0, 5.0);
  const Labels labels = labels_of(motion);
  // pi 3.5 / (2 5) sin(pi t / 5) = 1.0996 sin: above 0.35 from 0.516 s on, above 0.2 until 4.709 s.
  for (std::size_t i = 0; i < size; ++i) {
    const double t = static_cast<double>(i) * frame_step - 3.0;
    const bool in = t > 0.516 && t < 4.709;
    EXPECT_EQ(labels.classes[i] == static_cast<std::uint8_t>(Intention::lane_left), in) << t;
  }
  EXPECT_FALSE(labels.scored[35]);  // 0.5 s: one frame before the change
  EXPECT_TRUE(labels.scored[50]);
  EXPECT_TRUE(labels.scored[20]);
  EXPECT_TRUE(labels.scored[30]);   // at rest aside
  EXPECT_FALSE(labels.scored[33]);  // 0.206 m/s: on its way to 0.35
}

TEST(Labels, AMirroredMotionHasMirroredLabels) {
  TrueMotion motion = steady();
  add_move(motion, -3.5, 3.0, 5.0);
  const Labels labels = labels_of(motion);
  EXPECT_EQ(count(labels, Intention::lane_left), 0U);
  EXPECT_EQ(count(labels, Intention::lane_right), 42U);  // 3.6 to 7.7 s
}

TEST(Labels, AShortWayIsNoMoveAndAWayBackIsDoubtful) {
  TrueMotion motion = steady();
  add_move(motion, 0.5, 3.0, 1.5);
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size);
  EXPECT_TRUE(labels_of(motion).scored[37]);

  motion = steady();
  add_move(motion, 0.8, 3.0, 2.0);
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size);
  EXPECT_FALSE(labels_of(motion).scored[40]);

  motion = steady();
  add_move(motion, 1.5, 3.0, 2.0);
  add_move(motion, -1.5, 5.0, 2.0);
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size);
  EXPECT_FALSE(labels_of(motion).scored[40]);
}

TEST(Labels, WithinTheLaneOnlyASwerveCounts) {
  TrueMotion motion = steady();
  add_move(motion, 1.4, 3.0, 4.0);  // pi 1.4 / 8 = 0.55 m/s at most
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size);
  EXPECT_FALSE(labels_of(motion).scored[50]);

  for (double& each : motion.lateral) {
    each += 1.0;  // the same across the bound at 1.75 m
  }
  EXPECT_GT(count(labels_of(motion), Intention::lane_left), 20U);

  motion = steady();
  add_move(motion, 1.4, 3.0, 2.0);  // 1.1 m/s
  EXPECT_GT(count(labels_of(motion), Intention::lane_left), 10U);
}

TEST(Labels, BrakingIsBeyondTwoForThreeFramesAndASpeedLost) {
  TrueMotion motion = steady();
  add_braking(motion, -1.5, 28, 30);
  add_braking(motion, -4.0, 30, 45);
  add_braking(motion, -1.2, 45, 50);
  add_braking(motion, -0.9, 50, 60);
  const Labels labels = labels_of(motion);
  EXPECT_EQ(count(labels, Intention::brake), 20U);  // 30 to 49
  EXPECT_FALSE(labels.scored[28]);                  // on its way there
  EXPECT_TRUE(labels.scored[26]);
  ASSERT_EQ(labels.braking_times.size(), 1U);
  EXPECT_NEAR(labels.braking_times[0], 3.0, 1e-12);

  motion = steady();
  add_braking(motion, -4.0, 30, 32);  // too short to be sure, long enough for doubt? no: 0.2 s
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size);
  EXPECT_TRUE(labels_of(motion).scored[31]);

  motion = steady();
  add_braking(motion, -1.8, 30, 45);
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size);
  EXPECT_FALSE(labels_of(motion).scored[40]);
}

TEST(Labels, BothAtOnceAreOneClass) {
  TrueMotion motion = steady();
  add_move(motion, 3.5, 3.0, 5.0);
  add_braking(motion, -3.0, 50, 60);
  const Labels labels = labels_of(motion);
  EXPECT_EQ(count(labels, Intention::brake_left), 10U);
  EXPECT_EQ(count(labels, Intention::brake), 0U);
  EXPECT_EQ(count(labels, Intention::lane_left), 32U);
}

TEST(Labels, WhatTheEndsCutOffIsInDoubt) {
  TrueMotion motion = steady();
  add_move(motion, 3.5, 11.0, 5.0);  // 0.55 m of it are there
  const Labels labels = labels_of(motion);
  EXPECT_EQ(count(labels, Intention::maintain), size);
  EXPECT_FALSE(labels.scored[size - 1]);
  EXPECT_TRUE(labels.scored[100]);
}

TEST(Labels, OffTheLanesNobodyChangesThem) {
  TrueMotion motion = steady();
  std::fill(motion.lateral.begin(), motion.lateral.end(), std::nan(""));
  std::fill(motion.lateral_speed.begin(), motion.lateral_speed.end(), std::nan(""));
  add_braking(motion, -3.0, 50, 60);
  EXPECT_EQ(count(labels_of(motion), Intention::brake), 10U);
  EXPECT_EQ(count(labels_of(motion), Intention::maintain), size - 10U);
}

TEST(Labels, OfNothingAreNone) {
  EXPECT_TRUE(labels_of({}).classes.empty());
  EXPECT_THROW((void)labels_of({{0.0}, {}, {}, 3.5}), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::labels_test

#include "saca/onboard/collision/swept_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "saca/onboard/collision/approach.h"

namespace saca::collision::swept_boxes_test {
namespace {

using world::Footprint;
using world::Shape;
using world::Track;

constexpr Footprint car{.length = 4.5, .width = 1.8, .centre_x = 0.3};

Track straight_on(Vec2 p, Vec2 v, double yaw, int num_poses) {
  Track track{.start = 1.0, .step = 0.05, .X_WA = {}};
  for (int k = 0; k < num_poses; ++k) {
    track.X_WA.push_back({p + (k * track.step) * v, yaw});
  }
  return track;
}

/// A way with jerks that no vehicle makes, and turns through pi.
Track random_track(std::mt19937& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  std::uniform_int_distribution<std::size_t> num_poses(1, 40);
  Track track{.start = u(rng), .step = 0.05 + 0.04 * u(rng), .X_WA = {}};
  Pose pose{{8.0 * u(rng), 8.0 * u(rng)}, std::numbers::pi * u(rng)};
  track.X_WA.assign(num_poses(rng), pose);
  for (Pose& each : track.X_WA) {
    pose.p = pose.p + Vec2{u(rng), u(rng)};
    pose.yaw = wrap_angle(pose.yaw + 2.0 * u(rng) * u(rng));
    each = pose;
  }
  return track;
}

Footprint random_footprint(std::mt19937& rng) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const auto shape = static_cast<Shape>(static_cast<int>(3.0 * u(rng)));
  return {.shape = shape,
          .length = 0.5 + 5.0 * u(rng),
          .width = shape == Shape::segment ? 0.0 : 0.5 + 2.0 * u(rng),
          .centre_x = u(rng) - 0.5};
}

// Stepping through both motions is the reference.
TEST(SweptBoxes, NeverDenyThatBodiesComeNear) {
  std::mt19937 rng(5);
  int apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Footprint a = random_footprint(rng);
    const Footprint b = random_footprint(rng);
    const Track X_WA = random_track(rng);
    Track X_WB = random_track(rng);
    for (Pose& pose : X_WB.X_WA) {
      pose.p.x += 10.0;
    }
    const double start = std::uniform_real_distribution<double>(-1.5, 2.0)(rng);
    const double end = start + std::uniform_real_distribution<double>(0.0, 3.0)(rng);
    double least = 1e9;
    for (int k = 0; k <= 300; ++k) {
      const double time = start + (end - start) * k / 300.0;
      least = std::min(least, separation(a, pose_at(X_WA, time), b, pose_at(X_WB, time)).distance);
    }
    const SweptBoxes of_a(a, X_WA);
    const SweptBoxes of_b(b, X_WB);
    for (const double distance : {0.0, 0.5, 3.0}) {
      const bool may = may_come_near(of_a, of_b, start, end, distance);
      EXPECT_EQ(may, may_come_near(of_b, of_a, start, end, distance)) << i;
      EXPECT_TRUE(may || least > distance) << i;
      apart += may ? 0 : 1;
    }
  }
  EXPECT_GT(apart, 200);
}

// Two cars in lanes beside each other, 3.5 m apart less 1.8 m of width, pass: the octagons see the
// gap of 1.7 m in every direction in which roads mostly run.
TEST(SweptBoxes, SeeTheGapBetweenLanes) {
  for (const double course : {0.0, 0.25, 0.5, 0.75, 1.0, -0.5}) {
    const double yaw = course * std::numbers::pi;
    const SweptBoxes slow(car, straight_on({}, rotated({10.0, 0.0}, yaw), yaw, 201));
    const SweptBoxes fast(
        car, straight_on(rotated({-20.0, 3.5}, yaw), rotated({20.0, 0.0}, yaw), yaw, 201));
    EXPECT_FALSE(may_come_near(slow, fast, 1.0, 11.0, 1.69)) << course;
    EXPECT_TRUE(may_come_near(slow, fast, 1.0, 11.0, 1.71)) << course;
  }
}

// Behind each other at 10 m/s, with 0.2 s between octagons: the gap counts less what is driven.
TEST(SweptBoxes, ReachNoFartherAlongThanTheWayOfAPart) {
  const SweptBoxes last(car, straight_on({}, {10.0, 0.0}, 0.0, 201));
  const SweptBoxes first(car, straight_on({4.5 + 2.5, 0.0}, {10.0, 0.0}, 0.0, 201));
  EXPECT_FALSE(may_come_near(last, first, 1.0, 11.0, 0.49));
  EXPECT_TRUE(may_come_near(last, first, 1.0, 11.0, 2.5));
}

// Each stands at its ends: at the first pose before its time, at the last one after it.
TEST(SweptBoxes, OutsideItsTimesABodyRests) {
  const SweptBoxes comes(car, straight_on({}, {10.0, 0.0}, 0.0, 41));  // 20 m in 1 to 3 s
  const SweptBoxes before(car, straight_on({0.0, 0.0}, {}, 0.0, 1));
  const SweptBoxes after(car, straight_on({20.0, 0.0}, {}, 0.0, 1));
  EXPECT_TRUE(may_come_near(comes, before, 0.0, 0.5, 0.0));
  EXPECT_FALSE(may_come_near(comes, after, 0.0, 0.5, 0.0));
  EXPECT_FALSE(may_come_near(comes, before, 4.0, 9.0, 0.0));
  EXPECT_TRUE(may_come_near(comes, after, 4.0, 9.0, 0.0));
}

// What is far along on either track is found at its time only.
TEST(SweptBoxes, WhatCrossesLaterIsNotNearNow) {
  const SweptBoxes ahead(car, straight_on({}, {10.0, 0.0}, 0.0, 201));
  const SweptBoxes crossing(car,
                            straight_on({50.0, -100.0}, {0.0, 20.0}, 0.5 * std::numbers::pi, 201));
  EXPECT_TRUE(may_come_near(ahead, crossing, 1.0, 11.0, 0.0));
  EXPECT_TRUE(may_come_near(ahead, crossing, 5.5, 6.5, 0.0));
  EXPECT_FALSE(may_come_near(ahead, crossing, 1.0, 5.0, 0.0));
  EXPECT_FALSE(may_come_near(ahead, crossing, 7.0, 11.0, 0.0));
}

}  // namespace
}  // namespace saca::collision::swept_boxes_test

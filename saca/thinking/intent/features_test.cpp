#include "saca/thinking/intent/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::intent::features_test {
namespace {

float of(const Features& features, Feature which) {
  return features[static_cast<std::size_t>(which)];
}

/// Straight on at 20 m/s, in the middle of its lane, nobody ahead.
Observation cruising() {
  return {.speed = 20.0,
          .offset = 0.0,
          .lateral_speed = 0.0,
          .heading = 0.0,
          .lane_width = 3.5,
          .gap = std::numeric_limits<double>::infinity()};
}

TEST(Features, AreFiniteWhateverIsKnown) {
  std::mt19937 random(7);
  std::bernoulli_distribution known(0.6);
  std::normal_distribution<double> value(0.0, 100.0);
  ObservationHistory memory;
  for (int i = 0; i < 500; ++i) {
    const auto some = [&] { return known(random) ? value(random) : not_known; };
    Observation seen{.speed = std::abs(value(random)),
                     .acceleration = value(random),
                     .yaw_rate = value(random),
                     .offset = some(),
                     .lateral_speed = value(random),
                     .heading = value(random),
                     .lane_width = 3.0,
                     .gap = known(random) ? some() : std::numeric_limits<double>::infinity(),
                     .gap_speed = value(random),
                     .steering = some(),
                     .throttle = some(),
                     .brake = some()};
    memory.add(seen);
    for (const float each : memory.features()) {
      ASSERT_TRUE(std::isfinite(each));
      ASSERT_LE(std::abs(each), 3.0F);
    }
  }
}

TEST(Features, OfAMirroredWorldAreTheMirroredFeatures) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  ObservationHistory here;
  ObservationHistory mirror;
  for (int i = 0; i < 40; ++i) {
    Observation seen = cruising();
    seen.yaw_rate = 0.1 * normal(random);
    seen.offset = normal(random);
    seen.lateral_speed = normal(random);
    seen.heading = 0.05 * normal(random);
    seen.steering = 0.05 * normal(random);
    here.add(seen);
    for (double* each :
         {&seen.yaw_rate, &seen.offset, &seen.lateral_speed, &seen.heading, &seen.steering}) {
      *each = -*each;
    }
    mirror.add(seen);
    EXPECT_EQ(mirrored(here.features()), mirror.features());
  }
}

TEST(Features, SlopesAreThoseOfASteadyMotion) {
  ObservationHistory memory;
  for (int i = 0; i <= 30; ++i) {  // brakes with 3 m/s^2, drifts left with 0.5 m/s
    Observation seen = cruising();
    seen.speed = 20.0 - 0.3 * i;
    seen.offset = -1.0 + 0.05 * i;
    memory.add(seen);
    if (i == 0) {
      EXPECT_EQ(of(memory.features(), Feature::slope_10), 0.0F);  // nothing to compare with yet
    }
  }
  const Features found = memory.features();
  for (const Feature slope :
       {Feature::slope_03, Feature::slope_05, Feature::slope_10, Feature::slope_20}) {
    EXPECT_NEAR(of(found, slope), -1.0, 1e-5);
  }
  for (const Feature moved :
       {Feature::moved_03, Feature::moved_05, Feature::moved_10, Feature::moved_20}) {
    EXPECT_NEAR(of(found, moved), 0.5, 1e-5);
  }
  EXPECT_NEAR(of(found, Feature::lateral_way), 1.0, 1e-5);
  EXPECT_EQ(of(found, Feature::memory), 1.0F);
}

TEST(Features, CrossingALineIsNoJump) {
  ObservationHistory memory;
  for (int i = 0; i <= 20; ++i) {  // to the left with 1 m/s, from the middle into the next lane
    Observation seen = cruising();
    const double way = 1.0 + 0.1 * i;
    seen.offset = way < 1.75 ? way : way - 3.5;
    memory.add(seen);
  }
  EXPECT_NEAR(of(memory.features(), Feature::moved_20), 1.0, 1e-5);
  EXPECT_LT(of(memory.features(), Feature::offset), 0.0F);
}

TEST(Features, AnotherLeadIsNoBrakingLead) {
  ObservationHistory memory;
  Observation seen = cruising();
  seen.gap = 60.0;
  seen.gap_speed = 0.0;
  for (int i = 0; i < 10; ++i) {
    memory.add(seen);
  }
  seen.gap = 15.0;  // somebody has cut in, 8 m/s slower
  seen.gap_speed = -8.0;
  memory.add(seen);
  const Features found = memory.features();
  EXPECT_EQ(of(found, Feature::lead_slope_05), 0.0F);
  EXPECT_NEAR(of(found, Feature::closing), 1.6, 1e-6);
  EXPECT_NEAR(of(found, Feature::closing_time), 8.0 / 15.0, 1e-6);
  EXPECT_NEAR(of(found, Feature::needed_deceleration), 64.0 / 30.0 / 3.0, 1e-6);
}

TEST(Features, WhatIsNotKnownIsMasked) {
  ObservationHistory memory;
  memory.add({.speed = 10.0});
  const Features found = memory.features();
  for (const Feature mask :
       {Feature::lane_known, Feature::ahead_known, Feature::somebody_ahead, Feature::throttle_known,
        Feature::brake_known, Feature::steering_known}) {
    EXPECT_EQ(of(found, mask), 0.0F);
  }
  EXPECT_EQ(of(found, Feature::to_line), 0.0F);
}

// Brake lights are seen where no pedal is shared.
TEST(Features, EachControlHasAMaskOfItsOwn) {
  ObservationHistory memory;
  memory.add({.speed = 10.0, .brake = 1.0});
  const Features found = memory.features();
  EXPECT_EQ(of(found, Feature::brake_known), 1.0F);
  EXPECT_EQ(of(found, Feature::brake), 1.0F);
  EXPECT_EQ(of(found, Feature::throttle_known), 0.0F);
  EXPECT_EQ(of(found, Feature::steering_known), 0.0F);
}

TEST(ObservationHistory, RefusesToSpeakOfNothing) {
  ObservationHistory memory;
  EXPECT_THROW((void)memory.features(), ContractViolation);
  memory.add(cruising());
  memory.clear();
  EXPECT_THROW((void)memory.features(), ContractViolation);
}

}  // namespace
}  // namespace saca::intent::features_test

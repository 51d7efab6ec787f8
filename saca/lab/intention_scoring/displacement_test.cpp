#include "saca/lab/intention_scoring/displacement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saca/lab/intention_scoring/sequences_for_test.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_scoring::displacement_test {
namespace {

constexpr std::size_t size = 61;

/// 6 s in the middle of a lane, from 20 m/s on with this acceleration.
Sequence driving(double acceleration) {
  Sequence sequence{.name = "one", .site = "here", .group = "one"};
  for (std::size_t t = 0; t < size; ++t) {
    sequence.observations.push_back({.speed = 20.0 + acceleration * 0.1 * static_cast<double>(t),
                                     .acceleration = acceleration,
                                     .offset = 0.0,
                                     .lateral_speed = 0.0,
                                     .heading = 0.0,
                                     .lane_width = 3.5});
    sequence.labels.push_back(acceleration < -2.0 ? 3 : 0);
    sequence.scored.push_back(true);
  }
  return sequence;
}

Forecasts sure_of(const Sequence& sequence, intent::Intention intention) {
  Forecasts forecasts;
  for (auto& head : forecasts.at) {
    head.assign(sequence.labels.size(), mostly(static_cast<std::size_t>(intention), 1.0));
  }
  return forecasts;
}

double mean_of(const Displacements& found, Foresight foresight, std::size_t k) {
  return found.all[static_cast<std::size_t>(foresight)][k].mean();
}

TEST(Displacements, OfSteadyDrivingAreNone) {
  const Sequence sequence = driving(0.0);
  const auto found = displacements(sequence, sure_of(sequence, intent::Intention::maintain), {});
  for (std::size_t f = 0; f < num_foresights; ++f) {
    for (std::size_t k = 0; k < seconds_ahead.size(); ++k) {
      EXPECT_EQ(found.all[f][k].num, 7U);  // every half a second, 3 s before the end
      EXPECT_NEAR(found.all[f][k].mean(), 0.0, 1e-6);
      EXPECT_EQ(found.acting[f][k].num, 0U);
    }
  }
}

TEST(Displacements, OfBrakingAreTheTextbooksForConstantVelocity) {
  const Sequence sequence = driving(-3.0);
  const auto found = displacements(sequence, sure_of(sequence, intent::Intention::brake), {});
  for (std::size_t k = 0; k < seconds_ahead.size(); ++k) {
    const auto time = static_cast<double>(seconds_ahead[k]);
    EXPECT_NEAR(mean_of(found, Foresight::constant_velocity, k), 1.5 * time * time, 1e-9);
    EXPECT_NEAR(mean_of(found, Foresight::lane_keeping, k), 1.5 * time * time, 1e-9);
    EXPECT_NEAR(mean_of(found, Foresight::likeliest, k), 0.0, 0.01);  // it goes on braking so
    EXPECT_EQ(found.acting[0][k].num, 7U);
  }
}

TEST(Displacements, OfADriftAreWhatLaneKeepingMisses) {
  Sequence sequence = driving(0.0);
  for (std::size_t t = 0; t < size; ++t) {  // 0.4 m/s to the left, into the next lane
    const double way = 0.04 * static_cast<double>(t);
    sequence.observations[t].offset = way < 1.75 ? way : way - 3.5;
    sequence.observations[t].lateral_speed = 0.4;
  }
  const auto found = displacements(sequence, sure_of(sequence, intent::Intention::maintain), {});
  EXPECT_NEAR(mean_of(found, Foresight::lane_keeping, 1), 0.8, 1e-2);
  EXPECT_NEAR(mean_of(found, Foresight::constant_velocity, 1), 0.0, 0.02);  // the speed's slant
}

TEST(Displacements, LeaveOutWhereTheLaneIsLost) {
  Sequence sequence = driving(0.0);
  sequence.observations[31].offset = std::nan("");
  const auto found = displacements(sequence, sure_of(sequence, intent::Intention::maintain), {});
  EXPECT_EQ(found.all[0][0].num, 1U);  // only from the first frame on it stays known for 3 s
}

TEST(Displacement, HasMeanAndRootMeanSquare) {
  Displacement one;
  EXPECT_EQ(one.mean(), 0.0);
  one.add(3.0);
  one.add(4.0);
  EXPECT_NEAR(one.mean(), 3.5, 1e-12);
  EXPECT_NEAR(one.rms(), std::sqrt(12.5), 1e-12);
}

}  // namespace
}  // namespace saca::intention_scoring::displacement_test

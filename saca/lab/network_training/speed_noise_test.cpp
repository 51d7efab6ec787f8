#include "saca/lab/network_training/speed_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/features.h"

namespace saca::network_training::speed_noise_test {
namespace {

using intent::Feature;
using intent::Observation;

constexpr auto num_columns = static_cast<std::int64_t>(intent::num_features);
constexpr std::size_t num_frames = 60;

/// Somebody who wavers in the lane behind another, and whose lane is not known for a while.
std::vector<Observation> wavering() {
  std::vector<Observation> all;
  for (std::size_t t = 0; t < num_frames; ++t) {
    const double phase = 0.1 * static_cast<double>(t);
    Observation seen{
        .speed = 20.0 + std::sin(phase), .acceleration = std::cos(phase), .yaw_rate = 0.01};
    if (t < 25 || t >= 30) {
      seen.offset = 0.4 * std::sin(phase);
      seen.lateral_speed = 0.4 * std::cos(phase);
      seen.heading = 0.02 * std::cos(phase);
      seen.lane_width = 3.6;
      seen.gap = 30.0;
      seen.gap_speed = -1.0 - std::sin(phase);
    }
    all.push_back(seen);
  }
  return all;
}

torch::Tensor features_of(const std::vector<Observation>& observations) {
  torch::Tensor all = torch::empty({static_cast<std::int64_t>(observations.size()), num_columns});
  auto* to = all.data_ptr<float>();
  intent::ObservationHistory memory;
  for (const Observation& each : observations) {
    memory.add(each);
    const intent::Features now = memory.features();
    to = std::copy(now.begin(), now.end(), to);
  }
  return all;
}

TEST(SpeedNoise, ChangesFeaturesAsIfObservationsHadIt) {
  constexpr double rounding = 2e-5;  // of floats of about unit size, divided by 0.1 s
  std::mt19937_64 random(1);
  for (int draw = 0; draw < 20; ++draw) {
    const SpeedNoise noise = drawn_speed_noise(num_frames, 0.5, random);
    std::vector<Observation> observations = wavering();
    const torch::Tensor features = features_of(observations);
    add_speed_noise(features, noise);
    for (std::size_t t = 0; t < num_frames; ++t) {
      observations[t].speed += noise.speed[t];
      observations[t].gap_speed -= noise.speed[t];
      observations[t].acceleration += noise.acceleration[t];
    }
    const torch::Tensor expected = features_of(observations);
    EXPECT_TRUE(torch::allclose(features, expected, 0.0, rounding))
        << (features - expected).abs().max().item<float>();
  }
}

TEST(SpeedNoise, LeavesThePlaceInTheLaneAndWhoIsAhead) {
  const torch::Tensor before = features_of(wavering());
  const torch::Tensor after = before.clone();
  std::mt19937_64 random(1);
  add_speed_noise(after, drawn_speed_noise(num_frames, 0.5, random));
  std::set<Feature> changed;
  for (std::int64_t i = 0; i < num_columns; ++i) {
    if (!torch::equal(before.select(1, i), after.select(1, i))) {
      changed.insert(static_cast<Feature>(i));
    }
  }
  EXPECT_EQ(changed,
            (std::set{Feature::speed, Feature::acceleration, Feature::slope_03, Feature::slope_05,
                      Feature::slope_10, Feature::slope_20, Feature::time_gap, Feature::closing,
                      Feature::closing_time, Feature::needed_deceleration,
                      Feature::lateral_acceleration, Feature::steered_speed}));
}

TEST(SpeedNoise, OfNoSizeChangesNothing) {
  constexpr double rounding = 1e-6;  // of the gap, which is taken from an exponential
  const torch::Tensor before = features_of(wavering());
  const torch::Tensor after = before.clone();
  std::mt19937_64 random(1);
  add_speed_noise(after, drawn_speed_noise(num_frames, 0.0, random));
  EXPECT_TRUE(torch::allclose(before, after, 0.0, rounding));
}

TEST(SpeedNoise, MirrorsWithTheWorld) {
  torch::Tensor sign = torch::ones({num_columns});
  sign.narrow(0, static_cast<std::int64_t>(intent::first_mirrored),
              num_columns - static_cast<std::int64_t>(intent::first_mirrored)) = -1.0F;
  std::mt19937_64 random(1);
  const SpeedNoise noise = drawn_speed_noise(num_frames, 0.5, random);
  const torch::Tensor features = features_of(wavering());
  const torch::Tensor mirrored = features * sign;
  add_speed_noise(features, noise);
  add_speed_noise(mirrored, noise);
  EXPECT_TRUE(torch::equal(features * sign, mirrored));
}

TEST(SpeedNoise, HasTheRootMeanSquareThatIsAskedForAndIsCorrelatedOver1S) {
  std::mt19937_64 random(1);
  constexpr double sd = 0.3;
  constexpr int num = 4'000;
  double square = 0.0;
  double product = 0.0;
  for (int i = 0; i < num; ++i) {
    const SpeedNoise noise = drawn_speed_noise(11, sd, random);
    square += noise.speed[10] * noise.speed[10];
    product += noise.speed[10] * noise.speed[0];
  }
  // The mean square of products of two normal numbers, whose fourth moment is 9, has a standard
  // error of sqrt(8 / num), 4.5 %; the band is four of them. exp(-1) of it is left after 1 s.
  EXPECT_NEAR(square / num, sd * sd, 0.18 * sd * sd);
  EXPECT_NEAR(product / num, std::exp(-1.0) * sd * sd, 0.18 * sd * sd);
}

TEST(SpeedNoise, OfTheAccelerationIsItsSlopeOverHalfASecond) {
  std::mt19937_64 random(1);
  const SpeedNoise noise = drawn_speed_noise(20, 0.3, random);
  for (std::size_t t = 5; t < 20; ++t) {
    EXPECT_NEAR(noise.acceleration[t], (noise.speed[t] - noise.speed[t - 5]) / 0.5, 1e-12);
  }
}

TEST(SpeedNoise, RefusesWhatDoesNotFit) {
  std::mt19937_64 random(1);
  EXPECT_THROW(std::ignore = drawn_speed_noise(1, -0.1, random), ContractViolation);
  const torch::Tensor features = features_of(wavering());
  EXPECT_THROW(add_speed_noise(features, drawn_speed_noise(num_frames + 1, 0.1, random)),
               ContractViolation);
}

}  // namespace
}  // namespace saca::network_training::speed_noise_test

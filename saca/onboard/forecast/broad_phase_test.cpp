#include "saca/onboard/forecast/broad_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "saca/onboard/collision/gap.h"
#include "saca/thinking/rollout/encounters_for_test.h"
#include "tests/support/levels.h"

namespace saca::forecast::broad_phase_test {
namespace {

using world::Footprint;
using world::Shape;
using world::Track;

// Goes, turns, brakes and sways as road users do: its velocity changes by less than 10 m/s^2.
Track lively(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Track track{.start = 2.0 + u(rng), .step = 0.02, .X_WA = {}};
  const Vec2 p_W{15.0 * u(rng), 8.0 * u(rng)};
  const double yaw = 3.0 * u(rng);
  const double speed = 10.0 + 8.0 * u(rng);
  const double braking = 3.0 + 3.0 * u(rng);
  const double turning = 0.5 * u(rng);
  for (int k = 0; k <= 400; ++k) {
    const double t = std::min(k * track.step, speed / braking);
    const double way = speed * t - 0.5 * braking * t * t;
    const double aside = 0.3 * std::sin(2.0 * k * track.step);
    track.X_WA.push_back({p_W + rotated({way, aside}, yaw), yaw + turning * t});
  }
  return track;
}

TEST(PoseSamples, StandWhereTheTrackIs) {
  std::mt19937_64 rng(3);
  const Footprint body{.length = 4.5, .width = 1.8, .centre_x = 0.3};
  const Vec2 origin_W{500.0, -200.0};
  for (int i = 0; i < 20; ++i) {
    Track track = lively(rng);
    for (Pose& pose : track.X_WA) {
      pose.p = pose.p + origin_W;
    }
    const PoseSamples samples = pose_samples_of(track, body, 2.0, origin_W);
    for (std::size_t k = 0; k <= num_spans; ++k) {
      const Pose pose = pose_at(track, 2.0 + sample_time(k));
      const Vec2 middle_W = pose * Vec2{body.centre_x, 0.0} - origin_W;
      // Floats of some hundred metres.
      EXPECT_NEAR(static_cast<double>(samples.x[k]), middle_W.x, 1e-4);
      EXPECT_NEAR(static_cast<double>(samples.y[k]), middle_W.y, 1e-4);
      EXPECT_NEAR(static_cast<double>(samples.cosine[k]), std::cos(pose.yaw), 1e-5);
      EXPECT_NEAR(static_cast<double>(samples.sine[k]), std::sin(pose.yaw), 1e-5);
    }
  }
}

TEST(PoseSamples, SpansFollowEachOther) {
  EXPECT_EQ(sample_time(0), 0.0);
  EXPECT_NEAR(sample_time(num_spans), samples_end, 1e-12);
  for (std::size_t k = 0; k < num_spans; ++k) {
    EXPECT_LT(sample_time(k), sample_time(k + 1));
    EXPECT_EQ(span_at(0.5 * (sample_time(k) + sample_time(k + 1))), k);
  }
  EXPECT_EQ(span_at(1e9), num_spans);
}

// Of two that move, against samples every 5 ms: what is passed over holds no smaller gap.
TEST(PoseSamples, NothingIsNearerThanTheySay) {
  std::mt19937_64 rng(5);
  double slack = 0.0;
  int spans = 0;
  for (int i = 0; i < 200; ++i) {
    const Footprint car{.length = 4.5, .width = 1.8, .centre_x = 0.3};
    const Footprint other{i % 3 == 0 ? Shape::ellipse : Shape::box, 1.0 + i % 4, 1.0, 0.0};
    const Track a = lively(rng);
    const Track b = lively(rng);
    const PoseSamples of_a = pose_samples_of(a, car, 3.0, {});
    const PoseSamples of_b = pose_samples_of(b, other, 3.0, {});
    const auto groups = group_gaps(of_a, of_b);
    const auto near = std::make_unique<PairSamples>();
    compare_samples(of_a, of_b, 0, num_groups - 1, *near);
    for (std::size_t k = 0; k < 24; ++k) {
      double least = 1e9;
      double distance = 1e9;
      for (double time = sample_time(k); time <= sample_time(k + 1); time += 0.005) {
        const collision::Gap gap =
            collision::gap_between(collision::body_at(car, pose_at(a, 3.0 + time)),
                                   collision::body_at(other, pose_at(b, 3.0 + time)));
        least = std::min(least, gap.size);
        distance = std::min(
            distance,
            separation(car, pose_at(a, 3.0 + time), other, pose_at(b, 3.0 + time)).distance);
      }
      const auto told = static_cast<double>(near->least[k]);
      EXPECT_LE(told, least + 1e-4) << i << " span " << k;
      EXPECT_LE(static_cast<double>(groups[k / spans_per_group]), distance + 1e-4);
      if (k < 16 && least > 0.0 && least < 5.0) {
        slack += least - told;
        ++spans;
      }
    }
  }
  // Else it would be of no use.
  EXPECT_LT(slack / spans, 0.6);
}

TEST(PoseSamples, GapOfBoxesIsThatOfTheNarrowPhase) {
  std::mt19937_64 rng(6);
  const Footprint car{.length = 4.5, .width = 1.8, .centre_x = 0.3};
  for (int i = 0; i < 50; ++i) {
    const Track a = lively(rng);
    const Track b = lively(rng);
    const auto near = std::make_unique<PairSamples>();
    compare_samples(pose_samples_of(a, car, 3.0, {}), pose_samples_of(b, car, 3.0, {}), 0,
                    num_groups - 1, *near);
    for (std::size_t k = 0; k <= num_spans; ++k) {
      const collision::Gap gap =
          collision::gap_between(collision::body_at(car, pose_at(a, 3.0 + sample_time(k))),
                                 collision::body_at(car, pose_at(b, 3.0 + sample_time(k))));
      EXPECT_NEAR(static_cast<double>(near->gap[k]), gap.size, 1e-4 + 1e-5 * std::abs(gap.size));
    }
  }
}

// To the last bit, on whatever instruction sets there are here.
TEST(PoseSamples, AreTheSameOnEachInstructionSet) {
  std::mt19937_64 rng(7);
  const Footprint car{.length = 4.5, .width = 1.8, .centre_x = 0.3};
  for (const SimdLevel level : test::those_here({SimdLevel::avx2, SimdLevel::avx512})) {
    for (int i = 0; i < 50; ++i) {
      PoseSamples a = pose_samples_of(lively(rng), car, 3.0, {});
      PoseSamples b = pose_samples_of(lively(rng), car, 3.0, {});
      const auto wide = std::make_unique<PairSamples>();
      const auto plain = std::make_unique<PairSamples>();
      complete(a, car, level);
      complete(b, car, level);
      compare_samples(a, b, 0, num_groups - 1, *wide, level);
      const PoseSamples wide_a = a;
      complete(a, car, SimdLevel::baseline);
      complete(b, car, SimdLevel::baseline);
      compare_samples(a, b, 0, num_groups - 1, *plain, SimdLevel::baseline);
      EXPECT_EQ(wide_a.low_x, a.low_x);
      EXPECT_EQ(wide_a.high_y, a.high_y);
      for (std::size_t k = 0; k < num_spans; ++k) {
        EXPECT_EQ(wide_a.turn[k], a.turn[k]);
        EXPECT_EQ(wide->gap[k], plain->gap[k]);
        EXPECT_EQ(wide->n_x[k], plain->n_x[k]);
        EXPECT_EQ(wide->n_y[k], plain->n_y[k]);
        EXPECT_EQ(wide->least[k], plain->least[k]);
      }
    }
  }
}

TEST(PoseSamples, DirectionsAreThoseOfAngles) {
  for (float angle = -3.2F; angle < 3.2F; angle += 0.01F) {
    float cosine = 0.0F;
    float sine = 0.0F;
    direction(angle, cosine, sine);
    EXPECT_NEAR(cosine, std::cos(angle), 3e-6F) << angle;
    EXPECT_NEAR(sine, std::sin(angle), 3e-6F) << angle;
  }
}

}  // namespace
}  // namespace saca::forecast::broad_phase_test

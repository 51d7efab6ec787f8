#include "saca/lab/importers/smooth_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::importers::smooth_track_test {
namespace {

constexpr double dt = 0.1;

/// A motion that is known: pose, speed and acceleration at a time.
struct Known {
  Pose X_WA;
  double speed = 0.0;
};
using Motion = std::function<Known(double)>;

/// 15 m/s on a circle of 60 m to the left.
Known circling(double t) {
  constexpr double v = 15.0;
  constexpr double radius = 60.0;
  const double yaw = v * t / radius;
  return {{{radius * std::sin(yaw), radius * (1.0 - std::cos(yaw))}, wrap_angle(yaw)}, v};
}

/// 20 m/s, from 3 s on braking with 4 m/s^2 to 4 m/s, heading north-west.
Known braking(double t) {
  const double b = std::clamp(t - 3.0, 0.0, 4.0);
  const double s = 20.0 * t - 2.0 * b * b - 16.0 * std::max(0.0, t - 7.0);
  const double yaw = 0.75 * std::numbers::pi;
  return {{rotated({s, 0.0}, yaw), yaw}, 20.0 - 4.0 * b};
}

/// What a camera makes of it: noise of positions and speeds, headings from one frame to the next.
scenario::Recording recorded(const Motion& motion, double duration, double position_sd,
                             double speed_sd, unsigned seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  scenario::Recording recording;
  for (int k = 0; k * dt < duration; ++k) {
    const Known truth = motion(k * dt);
    scenario::Sample sample{k * dt, truth.X_WA, truth.speed + speed_sd * normal(rng), 0.0};
    sample.X_WA.p = sample.X_WA.p + Vec2{position_sd * normal(rng), position_sd * normal(rng)};
    sample.X_WA.yaw = wrap_angle(sample.X_WA.yaw + position_sd * normal(rng));
    recording.push_back(sample);
  }
  return recording;
}

struct Errors {
  double position = 0.0;  ///< rms [m]
  double heading = 0.0;   ///< rms [rad]
  double speed = 0.0;     ///< rms [m/s]
};

Errors errors(const scenario::Recording& smooth, const Motion& motion) {
  Errors sum;
  for (const scenario::Sample& sample : smooth) {
    const Known truth = motion(sample.time);
    const double p = norm(sample.X_WA.p - truth.X_WA.p);
    const double h = wrap_angle(sample.X_WA.yaw - truth.X_WA.yaw);
    sum.position += p * p;
    sum.heading += h * h;
    sum.speed += (sample.speed - truth.speed) * (sample.speed - truth.speed);
  }
  const auto n = static_cast<double>(smooth.size());
  return {std::sqrt(sum.position / n), std::sqrt(sum.heading / n), std::sqrt(sum.speed / n)};
}

// A parabola goes through constant acceleration exactly; lines through heading and speed bend
// neither here.
TEST(SmoothTrack, LeavesAStraightMotionWithoutNoiseAsItIs) {
  const Motion steady = [](double t) {
    return Known{{{12.0 * t, -3.0 * t}, std::atan2(-3.0, 12.0)}, std::hypot(12.0, 3.0)};
  };
  const SmoothTrack track = smooth_track(recorded(steady, 5.0, 0.0, 0.0, 1), dt);
  const Errors off = errors(track.samples, steady);
  EXPECT_LT(off.position, 1e-9);
  EXPECT_LT(off.heading, 1e-9);
  EXPECT_LT(off.speed, 1e-9);
  EXPECT_LT(track.hardest, 1e-6);
  EXPECT_EQ(track.num_outliers, 0U);
}

// Of the mean of a parabola over n = 15 points white noise leaves sqrt(9 / (4 n)) = 0.39, and at
// the ends, where the window is one-sided, up to sqrt(9 / 8) of a window of 8; speeds help there.
TEST(SmoothTrack, TakesMostOfTheNoiseOff) {
  for (const Motion& motion : {Motion(circling), Motion(braking)}) {
    constexpr double noise = 0.1;
    const scenario::Recording raw = recorded(motion, 9.0, noise, 0.3, 7);
    const SmoothTrack track = smooth_track(raw, dt);
    const Errors before = errors(raw, motion);
    const Errors after = errors(track.samples, motion);
    EXPECT_NEAR(before.position, noise * std::numbers::sqrt2, 0.03);
    EXPECT_LT(after.position, 0.5 * before.position);
    EXPECT_LT(after.speed, 0.25);  // the corners of braking are rounded
    EXPECT_LT(after.heading, 0.02);
    EXPECT_GT(track.rms_shift, 0.5 * before.position);
    EXPECT_LT(track.rms_shift, 1.1 * before.position);
  }
}

// 15^2 / 60 = 3.75 m/s^2 on the circle, 4 m/s^2 when braking; the largest of 90 samples keeps some
// noise.
TEST(SmoothTrack, FindsTheHardestAccelerationBehindTheNoise) {
  EXPECT_NEAR(smooth_track(recorded(circling, 9.0, 0.03, 0.1, 3), dt).hardest, 3.75, 1.0);
  EXPECT_NEAR(smooth_track(recorded(braking, 9.0, 0.03, 0.1, 3), dt).hardest, 4.0, 1.0);
  EXPECT_NEAR(smooth_track(recorded(circling, 9.0, 0.0, 0.0, 3), dt).samples[40].yaw_rate,
              15.0 / 60.0, 0.002);
}

TEST(SmoothTrack, ThrowsJumpsAwayAndBridgesGaps) {
  scenario::Recording raw = recorded(circling, 6.0, 0.02, 0.1, 5);
  raw[20].X_WA.p.y += 4.0;
  raw[21].X_WA.p.y += 4.0;
  raw.erase(raw.begin() + 40, raw.begin() + 43);
  const SmoothTrack track = smooth_track(raw, dt);
  EXPECT_EQ(track.num_outliers, 2U);
  EXPECT_EQ(track.num_filled, 3U);
  EXPECT_EQ(track.samples.size(), 60U);
  EXPECT_LT(errors(track.samples, circling).position, 0.1);
}

// Noise of a body that stands must not turn it, nor tell it to drive off.
TEST(SmoothTrack, WhoStandsKeepsItsHeading) {
  const Motion standing = [](double) { return Known{{{3.0, 4.0}, -3.1}, 0.0}; };
  scenario::Recording raw = recorded(standing, 6.0, 0.05, 0.0, 11);
  const SmoothTrack track = smooth_track(raw, dt);
  for (const scenario::Sample& sample : track.samples) {
    EXPECT_NEAR(wrap_angle(sample.X_WA.yaw + 3.1), 0.0, 0.03);
    EXPECT_LT(sample.speed, 0.3);
  }
}

TEST(SmoothTrack, WhoStopsKeepsTheHeadingOfItsMotion) {
  const Motion stopping = [](double t) {
    const double b = std::min(t, 4.0);
    return Known{{rotated({8.0 * b - b * b, 0.0}, 1.0), 1.0}, 8.0 - 2.0 * b};
  };
  for (const scenario::Sample& sample :
       smooth_track(recorded(stopping, 8.0, 0.03, 0.1, 2), dt).samples) {
    EXPECT_NEAR(sample.X_WA.yaw, 1.0, 0.05) << sample.time;
  }
}

TEST(SmoothTrack, WhoReversesLooksWhereItLooked) {
  const Motion reversing = [](double t) { return Known{{{-3.0 * t, 0.0}, 0.0}, -3.0}; };
  for (const scenario::Sample& sample :
       smooth_track(recorded(reversing, 4.0, 0.0, 0.0, 2), dt).samples) {
    EXPECT_NEAR(sample.X_WA.yaw, 0.0, 1e-6);
    EXPECT_EQ(sample.speed, 0.0);
  }
}

// Turning and moving the world turns and moves the result.
TEST(SmoothTrack, DoesNotCareWhereTheWorldIs) {
  const scenario::Recording raw = recorded(circling, 5.0, 0.05, 0.1, 9);
  const Pose X_VW{{30.0, -70.0}, 2.0};
  scenario::Recording moved = raw;
  for (scenario::Sample& sample : moved) {
    sample.X_WA = X_VW * sample.X_WA;
  }
  const SmoothTrack a = smooth_track(raw, dt);
  const SmoothTrack b = smooth_track(moved, dt);
  for (std::size_t k = 0; k < a.samples.size(); ++k) {
    const Pose turned = X_VW * a.samples[k].X_WA;
    EXPECT_LT(norm(turned.p - b.samples[k].X_WA.p), 1e-9);
    EXPECT_NEAR(wrap_angle(turned.yaw - b.samples[k].X_WA.yaw), 0.0, 1e-9);
    EXPECT_NEAR(a.samples[k].speed, b.samples[k].speed, 1e-9);
  }
}

TEST(SmoothTrack, WantsFiveSamples) {
  const scenario::Recording raw = recorded(circling, 0.35, 0.0, 0.0, 1);
  EXPECT_THROW((void)smooth_track(raw, dt), ContractViolation);
}

}  // namespace
}  // namespace saca::importers::smooth_track_test

#include "saca/lab/recordings/rts_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/lab/recordings/series.h"

namespace saca::recordings::rts_smoother_test {
namespace {

constexpr double dt = 0.1;
constexpr double pi = std::numbers::pi;

/// Solves a x = b; a positive definite.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t r = p + 1; r < n; ++r) {
      const double factor = a[r][p] / a[p][p];
      for (std::size_t c = p; c < n; ++c) {
        a[r][c] -= factor * a[p][c];
      }
      b[r] -= factor * b[p];
    }
  }
  std::vector<double> x(n);
  for (std::size_t p = n; p-- > 0;) {
    x[p] = b[p];
    for (std::size_t c = p + 1; c < n; ++c) {
      x[p] -= a[p][c] * x[c];
    }
    x[p] /= a[p][p];
  }
  return x;
}

/// From each state to the next, with the noise between them.
void add_transitions(const SmootherSettings& settings, std::vector<std::vector<double>>& a) {
  const double q =
      std::pow(settings.position_sd, 2) * dt * std::pow(2.0 * pi * settings.cut_off, 6);
  // Inverse of the noise's covariance, by hand: q [t^5/20 t^4/8 t^3/6; ...].
  const double t = dt;
  const std::vector<std::vector<double>> w{
      {720.0 / (q * std::pow(t, 5)), -360.0 / (q * std::pow(t, 4)), 60.0 / (q * std::pow(t, 3))},
      {-360.0 / (q * std::pow(t, 4)), 192.0 / (q * std::pow(t, 3)), -36.0 / (q * t * t)},
      {60.0 / (q * std::pow(t, 3)), -36.0 / (q * t * t), 9.0 / (q * t)}};
  const std::vector<std::vector<double>> f{{1.0, t, 0.5 * t * t}, {0.0, 1.0, t}, {0.0, 0.0, 1.0}};
  for (std::size_t k = 0; 3 * (k + 1) < a.size(); ++k) {
    // Residual x[k + 1] - F x[k] = D z with z = (x[k], x[k + 1]).
    std::vector<std::vector<double>> d(3, std::vector<double>(6, 0.0));
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        d[r][c] = -f[r][c];
      }
      d[r][3 + r] = 1.0;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t r = 0; r < 3; ++r) {
          for (std::size_t c = 0; c < 3; ++c) {
            a[3 * k + i][3 * k + j] += d[r][i] * w[r][c] * d[c][j];
          }
        }
      }
    }
  }
}

/// The same likelihood maximised at once: least squares over all states of all times.
AxisMotion by_least_squares(const std::vector<double>& positions, const std::vector<double>& speeds,
                            const SmootherSettings& settings) {
  const std::size_t n = positions.size();
  std::vector<std::vector<double>> a(3 * n, std::vector<double>(3 * n, 0.0));
  std::vector<double> b(3 * n, 0.0);
  const double first_sd = 1e3 * settings.position_sd + 1.0;
  const std::vector<double> prior{first_sd, 100.0, 10.0};
  for (std::size_t i = 0; i < 3; ++i) {
    a[i][i] += 1.0 / (prior[i] * prior[i]);
  }
  add_transitions(settings, a);
  for (std::size_t k = 0; k < n; ++k) {
    if (!std::isnan(positions[k])) {
      a[3 * k][3 * k] += 1.0 / std::pow(settings.position_sd, 2);
      b[3 * k] += positions[k] / std::pow(settings.position_sd, 2);
    }
    if (!speeds.empty() && !std::isnan(speeds[k])) {
      a[3 * k + 1][3 * k + 1] += 1.0 / std::pow(settings.speed_sd, 2);
      b[3 * k + 1] += speeds[k] / std::pow(settings.speed_sd, 2);
    }
  }
  const std::vector<double> x = solved(a, b);
  AxisMotion motion;
  for (std::size_t k = 0; k < n; ++k) {
    motion.position.push_back(x[3 * k]);
    motion.velocity.push_back(x[3 * k + 1]);
    motion.acceleration.push_back(x[3 * k + 2]);
  }
  return motion;
}

TEST(RtsSmoother, IsTheLikeliestMotion) {
  std::mt19937 chance(5);
  std::normal_distribution<double> noise(0.0, 0.2);
  std::vector<double> positions;
  std::vector<double> speeds;
  for (int k = 0; k < 25; ++k) {
    positions.push_back(k == 0 ? 0.0 : 1.1 * k - 0.02 * k * k + noise(chance));
    speeds.push_back(11.0 - 0.4 * k + noise(chance));
  }
  for (const int k : {3, 4, 5, 17, 24}) {
    positions[static_cast<std::size_t>(k)] = missing;
  }
  speeds[9] = missing;
  const SmootherSettings settings{.cut_off = 0.5, .position_sd = 0.2, .speed_sd = 0.3};
  for (const bool with_speeds : {false, true}) {
    const std::vector<double> used = with_speeds ? speeds : std::vector<double>{};
    const AxisMotion ours = smooth_axis(positions, used, dt, settings);
    const AxisMotion truth = by_least_squares(positions, used, settings);
    for (std::size_t k = 0; k < positions.size(); ++k) {
      // Rounding: the weights of the oracle's equations span ten powers of ten.
      EXPECT_NEAR(ours.position[k], truth.position[k], 1e-5);
      EXPECT_NEAR(ours.velocity[k], truth.velocity[k], 1e-5);
      EXPECT_NEAR(ours.acceleration[k], truth.acceleration[k], 1e-5);
    }
  }
}

TEST(RtsSmoother, LeavesConstantAccelerationAsItIs) {
  std::vector<double> positions;
  for (int k = 0; k < 60; ++k) {
    const double t = dt * k;
    positions.push_back(-7.0 + 12.0 * t - 0.5 * 3.0 * t * t);
  }
  const AxisMotion motion = smooth_axis(positions, {}, dt);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    EXPECT_NEAR(motion.position[k], positions[k], 1e-3);  // what is likely before weighs a little
    EXPECT_NEAR(motion.velocity[k], 12.0 - 0.3 * static_cast<double>(k), 0.02);
    EXPECT_NEAR(motion.acceleration[k], -3.0, 0.02);
  }
}

TEST(RtsSmoother, PassesHalfOfTheCutOffAndNoDelay) {
  for (const double cut_off : {0.3, 0.45, 0.6}) {
    for (const double share : {0.5, 1.0, 2.0}) {
      const double w = 2.0 * pi * cut_off * share;
      std::vector<double> positions;
      for (int k = 0; k < 800; ++k) {
        positions.push_back(std::sin(w * dt * k));
      }
      const AxisMotion motion = smooth_axis(positions, {}, dt, {.cut_off = cut_off});
      const double passed = 1.0 / (1.0 + std::pow(share, 6));
      for (std::size_t k = 300; k < 500; ++k) {  // far from the ends
        // 1 %: the theory is of continuous time.
        EXPECT_NEAR(motion.position[k], passed * positions[k], 0.01);
        EXPECT_NEAR(motion.velocity[k], passed * w * std::cos(w * dt * static_cast<double>(k)),
                    0.01 * w);
      }
    }
  }
}

TEST(RtsSmoother, IsTheSameElsewhereMirroredAndBackwards) {
  std::mt19937 chance(8);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<double> positions;
  for (int k = 0; k < 50; ++k) {
    positions.push_back(k == 0 ? 0.0 : positions.back() + 0.5 + noise(chance));
  }
  std::vector<double> away = positions;
  std::vector<double> mirrored = positions;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    away[k] += 4e6;
    mirrored[k] *= -1.0;
  }
  const AxisMotion motion = smooth_axis(positions, {}, dt);
  const AxisMotion far = smooth_axis(away, {}, dt);
  const AxisMotion other = smooth_axis(mirrored, {}, dt);
  const AxisMotion back =
      smooth_axis(std::vector<double>(positions.rbegin(), positions.rend()), {}, dt);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    EXPECT_NEAR(far.position[k] - 4e6, motion.position[k], 1e-6);  // digits of 4e6
    EXPECT_NEAR(far.acceleration[k], motion.acceleration[k], 1e-4);
    EXPECT_EQ(other.acceleration[k], -motion.acceleration[k]);
    // What is likely at the first sample is not the same at the last one: a small weight.
    EXPECT_NEAR(back.velocity[positions.size() - 1 - k], -motion.velocity[k], 0.05);
  }
}

/// Errors, root mean square, of position, velocity and acceleration.
struct Errors {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

Errors errors_of(const AxisMotion& found, const AxisMotion& truth) {
  const auto rms = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      sum += std::pow(a[k] - b[k], 2);
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
  };
  return {rms(found.position, truth.position), rms(found.velocity, truth.velocity),
          rms(found.acceleration, truth.acceleration)};
}

/// Braking from 15 m/s: 3 s steady, 1 s to -4 m/s^2, 2 s so, 1 s back to 0, 3 s steady.
AxisMotion braking() {
  AxisMotion motion;
  double p = 0.0;
  double v = 15.0;
  constexpr int fine = 100;
  for (int k = 0; k <= 100 * fine; ++k) {
    const double t = dt * k / fine;
    const double a = -4.0 * std::clamp(std::min(t - 3.0, 7.0 - t), 0.0, 1.0);
    if (k % fine == 0) {
      motion.position.push_back(p);
      motion.velocity.push_back(v);
      motion.acceleration.push_back(a);
    }
    p += v * dt / fine;
    v += a * dt / fine;
  }
  return motion;
}

/// A lane change of 3.5 m within 5 s: minimum jerk (Flash, Hogan 1985).
AxisMotion lane_change() {
  AxisMotion motion;
  for (int k = 0; k <= 100; ++k) {
    const double s = std::clamp((dt * k - 2.5) / 5.0, 0.0, 1.0);
    motion.position.push_back(3.5 *
                              (10 * std::pow(s, 3) - 15 * std::pow(s, 4) + 6 * std::pow(s, 5)));
    motion.velocity.push_back(3.5 / 5.0 * (30 * s * s - 60 * std::pow(s, 3) + 30 * std::pow(s, 4)));
    motion.acceleration.push_back(3.5 / 25.0 * (60 * s - 180 * s * s + 120 * std::pow(s, 3)));
  }
  return motion;
}

struct Measured {
  std::vector<double> positions;
  std::vector<double> speeds;
};

Measured measured(const AxisMotion& truth, double position_sd, double speed_sd, unsigned seed) {
  std::mt19937 chance(seed);
  std::normal_distribution<double> noise;
  Measured made;
  for (std::size_t k = 0; k < truth.position.size(); ++k) {
    made.positions.push_back(truth.position[k] + position_sd * noise(chance));
    made.speeds.push_back(truth.velocity[k] + speed_sd * noise(chance));
  }
  return made;
}

AxisMotion by_differences(const Measured& noisy) {
  AxisMotion motion{noisy.positions, {}, {}};
  const auto slope = [](const std::vector<double>& values) {
    std::vector<double> slopes;
    const std::size_t last = values.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      const std::size_t a = k > 0 ? k - 1 : 0;
      const std::size_t b = std::min(k + 1, last);
      slopes.push_back((values[b] - values[a]) / (dt * static_cast<double>(b - a)));
    }
    return slopes;
  };
  motion.velocity = slope(noisy.positions);
  motion.acceleration = slope(motion.velocity);
  return motion;
}

/// As the importer smooths and judges accelerations: a parabola over +-0.7 s through positions and
/// speeds, the slope of its velocities over +-0.2 s.
AxisMotion by_parabolas(const Measured& noisy, double position_sd, double speed_sd) {
  const Fit fit =
      parabola_fit(noisy.positions, noisy.speeds, dt, 7, std::pow(position_sd / speed_sd, 2));
  return {fit.values, fit.slopes, line_fit(fit.slopes, dt, 2).slopes};
}

TEST(RtsSmoother, IsNearerTheTruthThanDifferencesAndParabolas) {
  constexpr double position_sd = 0.15;  // as found in NGSIM's tracks, about
  constexpr double speed_sd = 0.4;
  for (const AxisMotion& truth : {braking(), lane_change()}) {
    Errors ours;
    Errors differences;
    Errors parabolas;
    constexpr unsigned draws = 20;
    for (unsigned seed = 0; seed < draws; ++seed) {
      const Measured noisy = measured(truth, position_sd, speed_sd, seed);
      const auto add = [](Errors& sum, const Errors& e) {
        sum.position += e.position / draws;
        sum.velocity += e.velocity / draws;
        sum.acceleration += e.acceleration / draws;
      };
      add(ours, errors_of(smooth_axis(noisy.positions, noisy.speeds, dt,
                                      {.position_sd = position_sd, .speed_sd = speed_sd}),
                          truth));
      add(differences, errors_of(by_differences(noisy), truth));
      add(parabolas, errors_of(by_parabolas(noisy, position_sd, speed_sd), truth));
    }
    EXPECT_LT(ours.position, differences.position);
    EXPECT_LT(ours.velocity, differences.velocity);
    EXPECT_LT(ours.acceleration, 0.1 * differences.acceleration);
    EXPECT_LT(ours.position, parabolas.position);
    EXPECT_LT(ours.velocity, parabolas.velocity);
    EXPECT_LT(ours.acceleration, parabolas.acceleration);
    // What labels may count on.
    EXPECT_LT(ours.position, 0.05);
    EXPECT_LT(ours.velocity, 0.1);
    EXPECT_LT(ours.acceleration, 0.25);
  }
}

TEST(RtsSmoother, BridgesGaps) {
  const AxisMotion truth = lane_change();
  Measured noisy = measured(truth, 0.05, 0.1, 3);
  for (std::size_t k = 45; k < 55; ++k) {  // a second in the middle of it
    noisy.positions[k] = missing;
  }
  const AxisMotion found = smooth_axis(noisy.positions, {}, dt, {.position_sd = 0.05});
  for (std::size_t k = 40; k < 60; ++k) {
    EXPECT_NEAR(found.position[k], truth.position[k], 0.1) << k;
    EXPECT_NEAR(found.velocity[k], truth.velocity[k], 0.2) << k;
  }
  // Before the first and after the last known one it goes on as it went.
  std::vector<double> line(30, missing);
  for (std::size_t k = 10; k < 20; ++k) {
    line[k] = static_cast<double>(k);
  }
  const AxisMotion on = smooth_axis(line, {}, dt);
  EXPECT_NEAR(on.position[0], 0.0, 0.3);
  EXPECT_NEAR(on.position[29], 29.0, 0.3);
}

TEST(RtsSmoother, TakesOneSampleAlone) {
  const AxisMotion still = smooth_axis({3.0}, {}, dt);
  EXPECT_NEAR(still.position[0], 3.0, 1e-6);
  EXPECT_NEAR(still.velocity[0], 0.0, 1e-6);
  const AxisMotion moving = smooth_axis({3.0, missing}, {2.0, missing}, dt, {.speed_sd = 0.1});
  EXPECT_NEAR(moving.position[1], 3.2, 1e-3);  // the first speed's likely size weighs a millionth
}

TEST(RtsSmoother, RefusesWhatIsNoMeasurement) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)smooth_axis({}, {}, dt), ContractViolation);
  EXPECT_THROW((void)smooth_axis({missing, missing}, {}, dt), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0, inf}, {}, dt), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0, 2.0}, {1.0}, dt), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0}, {}, 0.0), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0}, {}, missing), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0}, {}, dt, {.cut_off = 0.0}), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0}, {}, dt, {.position_sd = missing}), ContractViolation);
  EXPECT_THROW((void)smooth_axis({1.0}, {}, dt, {.speed_sd = -1.0}), ContractViolation);
}

}  // namespace
}  // namespace saca::recordings::rts_smoother_test

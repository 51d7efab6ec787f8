#include "saca/lab/recordings/rts_smoother.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::recordings {
namespace {

using Vec3 = std::array<double, 3>;  // position, velocity, acceleration
using Mat3 = std::array<Vec3, 3>;

constexpr double first_speed_sd = 100.0;        // [m/s]: anything that moves on a road
constexpr double first_acceleration_sd = 10.0;  // [m/s^2]: likewise
constexpr double first_position_sds = 1e3;      // of a measured position

Vec3 product(const Mat3& a, const Vec3& x) {
  Vec3 y{};
  for (std::size_t r = 0; r < 3; ++r) {
    y[r] = a[r][0] * x[0] + a[r][1] * x[1] + a[r][2] * x[2];
  }
  return y;
}

Mat3 product(const Mat3& a, const Mat3& b) {
  Mat3 c{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 3; ++k) {
      c[r][k] = a[r][0] * b[0][k] + a[r][1] * b[1][k] + a[r][2] * b[2][k];
    }
  }
  return c;
}

Mat3 transposed(const Mat3& a) {
  Mat3 t{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 3; ++k) {
      t[r][k] = a[k][r];
    }
  }
  return t;
}

/// a + sign * b, and the mean of that and its transpose: rounding must not make it lopsided.
Mat3 symmetric_sum(const Mat3& a, const Mat3& b, double sign) {
  Mat3 sum{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[r][k] = 0.5 * (a[r][k] + a[k][r] + sign * (b[r][k] + b[k][r]));
    }
  }
  return sum;
}

/// Of a symmetric, positive definite matrix: L L^T = a.
Mat3 inverse_of(const Mat3& a) {
  Mat3 lower{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k <= r; ++k) {
      double sum = a[r][k];
      for (std::size_t m = 0; m < k; ++m) {
        sum -= lower[r][m] * lower[k][m];
      }
      lower[r][k] = r == k ? std::sqrt(sum) : sum / lower[k][k];
    }
  }
  Mat3 inverse{};
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 x{};
    x[k] = 1.0;
    for (std::size_t r = 0; r < 3; ++r) {  // forwards: L y = e
      for (std::size_t m = 0; m < r; ++m) {
        x[r] -= lower[r][m] * x[m];
      }
      x[r] /= lower[r][r];
    }
    for (std::size_t r = 3; r-- > 0;) {  // backwards: L^T x = y
      for (std::size_t m = r + 1; m < 3; ++m) {
        x[r] -= lower[m][r] * x[m];
      }
      x[r] /= lower[r][r];
    }
    for (std::size_t r = 0; r < 3; ++r) {
      inverse[r][k] = x[r];
    }
  }
  return inverse;
}

struct Estimate {
  Vec3 mean{};
  Mat3 covariance{};
};

/// How the state goes on over a step.
struct Dynamics {
  Mat3 transition{};
  Mat3 noise{};
};

/// Acceleration as a random walk driven by white noise of density q. In continuous time, of
/// positions with noise of density R = sd^2 step, the best smoother passes 1 / (1 + w^6 R / q) of
/// angular frequency w: one half at the cut-off.
Dynamics dynamics_of(double step, const SmootherSettings& settings) {
  const double w = 2.0 * std::numbers::pi * settings.cut_off;
  const double q = settings.position_sd * settings.position_sd * step * std::pow(w, 6);
  const double t = step;
  Dynamics dynamics;
  dynamics.transition = {{{1.0, t, 0.5 * t * t}, {0.0, 1.0, t}, {0.0, 0.0, 1.0}}};
  dynamics.noise = {
      {{q * std::pow(t, 5) / 20.0, q * std::pow(t, 4) / 8.0, q * std::pow(t, 3) / 6.0},
       {q * std::pow(t, 4) / 8.0, q * std::pow(t, 3) / 3.0, q * t * t / 2.0},
       {q * std::pow(t, 3) / 6.0, q * t * t / 2.0, q * t}}};
  return dynamics;
}

Estimate predicted(const Estimate& now, const Dynamics& dynamics) {
  const Mat3& f = dynamics.transition;
  return {product(f, now.mean),
          symmetric_sum(product(product(f, now.covariance), transposed(f)), dynamics.noise, 1.0)};
}

/// Takes in a measurement of one part of the state; NaN: none.
void take_in(Estimate& now, std::size_t part, double value, double sd) {
  if (std::isnan(value)) {
    return;
  }
  const double spread = now.covariance[part][part] + sd * sd;
  const double surprise = value - now.mean[part];
  const Vec3 column{now.covariance[0][part], now.covariance[1][part], now.covariance[2][part]};
  Mat3 known{};
  for (std::size_t r = 0; r < 3; ++r) {
    now.mean[r] += column[r] / spread * surprise;
    for (std::size_t k = 0; k < 3; ++k) {
      known[r][k] = column[r] * column[k] / spread;
    }
  }
  now.covariance = symmetric_sum(now.covariance, known, -1.0);
}

/// Takes the future into account, from the last estimate back.
void go_back(std::vector<Estimate>& estimates, const std::vector<Estimate>& expected,
             const Dynamics& dynamics) {
  for (std::size_t k = estimates.size() - 1; k-- > 0;) {
    Estimate& now = estimates[k];
    const Mat3 gain = product(product(now.covariance, transposed(dynamics.transition)),
                              inverse_of(expected[k + 1].covariance));
    Vec3 change{};
    for (std::size_t r = 0; r < 3; ++r) {
      change[r] = estimates[k + 1].mean[r] - expected[k + 1].mean[r];
    }
    const Vec3 correction = product(gain, change);
    for (std::size_t r = 0; r < 3; ++r) {
      now.mean[r] += correction[r];
    }
  }
}

void check_inputs(const std::vector<double>& positions, const std::vector<double>& speeds,
                  double step, const SmootherSettings& settings) {
  const auto is_known = [](double value) { return !std::isnan(value); };
  const auto is_infinite = [](double value) { return std::isinf(value); };
  expects(std::any_of(positions.begin(), positions.end(), is_known), "a position is known");
  expects(speeds.empty() || speeds.size() == positions.size(), "as many speeds as positions");
  expects(std::none_of(positions.begin(), positions.end(), is_infinite) &&
              std::none_of(speeds.begin(), speeds.end(), is_infinite),
          "positions and speeds are finite or NaN");
  expects(step > 0.0 && std::isfinite(step), "step > 0");
  expects(settings.cut_off > 0.0 && std::isfinite(settings.cut_off), "cut_off > 0");
  expects(settings.position_sd > 0.0 && std::isfinite(settings.position_sd), "position_sd > 0");
  expects(settings.speed_sd > 0.0, "speed_sd > 0");
}

}  // namespace

AxisMotion smooth_axis(const std::vector<double>& positions, const std::vector<double>& speeds,
                       double step, const SmootherSettings& settings) {
  check_inputs(positions, speeds, step, settings);
  const Dynamics dynamics = dynamics_of(step, settings);
  const bool use_speeds = !speeds.empty() && std::isfinite(settings.speed_sd);
  const auto first =
      std::find_if(positions.begin(), positions.end(), [](double p) { return !std::isnan(p); });
  // About the first position, so that far-off coordinates cost no digits.
  const double origin = *first;
  Estimate now;
  const double first_sd = first_position_sds * settings.position_sd + 1.0;
  now.covariance[0][0] = first_sd * first_sd;
  now.covariance[1][1] = first_speed_sd * first_speed_sd;
  now.covariance[2][2] = first_acceleration_sd * first_acceleration_sd;
  std::vector<Estimate> expected;
  std::vector<Estimate> estimates;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (k > 0) {
      now = predicted(now, dynamics);
    }
    expected.push_back(now);
    take_in(now, 0, positions[k] - origin, settings.position_sd);
    if (use_speeds) {
      take_in(now, 1, speeds[k], settings.speed_sd);
    }
    estimates.push_back(now);
  }
  go_back(estimates, expected, dynamics);
  AxisMotion motion;
  for (const Estimate& estimate : estimates) {
    motion.position.push_back(origin + estimate.mean[0]);
    motion.velocity.push_back(estimate.mean[1]);
    motion.acceleration.push_back(estimate.mean[2]);
  }
  return motion;
}

}  // namespace saca::recordings

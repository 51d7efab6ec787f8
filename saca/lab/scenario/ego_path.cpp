#include "saca/lab/scenario/ego_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"
#include "saca/lab/recordings/series.h"

namespace saca::scenario {
namespace {

constexpr double offset_sd = 0.2;          // of d while the lane is kept [m]; see the header
constexpr double correlation_time = 1.5;   // of d [s]
constexpr double start_heading_sd = 0.03;  // [rad]
constexpr double unusual = 2.0;            // beyond so many offset_sd samples count less
constexpr int num_rounds = 10;             // of reweighting; it settles in a few

/// d and heading as functions of the unknowns: offset and heading at the start, bias, curvature.
struct LinearMotion {
  std::vector<double> s;
  std::vector<double> turned;   ///< by the gyro as it is [rad]
  std::vector<double> drift;    ///< d by the gyro as it is [m]
  std::vector<double> by_bias;  ///< d for each unit of bias
  std::vector<double> by_curvature;

  [[nodiscard]] std::array<double, 4> effects(std::size_t k) const {
    return {1.0, s[k], by_bias[k], by_curvature[k]};
  }
  [[nodiscard]] double d(std::size_t k, const std::array<double, 4>& x) const {
    return drift[k] + x[0] + x[1] * s[k] + x[2] * by_bias[k] + x[3] * by_curvature[k];
  }
};

LinearMotion linear_motion(const std::vector<double>& speed, const std::vector<double>& yaw_rate,
                           double step) {
  LinearMotion motion;
  motion.s = recordings::integral(speed, step);
  motion.turned = recordings::integral(yaw_rate, step);
  std::vector<double> drift_rate(speed.size());
  std::vector<double> bias_rate(speed.size());
  std::vector<double> curvature_rate(speed.size());
  for (std::size_t k = 0; k < speed.size(); ++k) {
    drift_rate[k] = speed[k] * motion.turned[k];
    bias_rate[k] = -speed[k] * step * static_cast<double>(k);
    curvature_rate[k] = -speed[k] * motion.s[k];
  }
  motion.drift = recordings::integral(drift_rate, step);
  motion.by_bias = recordings::integral(bias_rate, step);
  motion.by_curvature = recordings::integral(curvature_rate, step);
  return motion;
}

/// The unknowns with the largest posterior.
std::array<double, 4> most_likely(const LinearMotion& motion, double step,
                                  const LaneKeeping& keeping) {
  const double sample_weight =
      std::min(1.0, step / (2.0 * correlation_time)) / (offset_sd * offset_sd);
  const auto precision = [](double sd) { return 1.0 / (sd * sd); };
  std::array<double, 4> x{0.0, 0.0, keeping.bias, 0.0};
  for (int round = 0; round < num_rounds; ++round) {
    recordings::Normal4 normal;
    normal.add({0.0, 1.0, 0.0, 0.0}, 0.0, precision(start_heading_sd));
    normal.add({0.0, 0.0, 1.0, 0.0}, keeping.bias, precision(keeping.bias_sd));
    normal.add({0.0, 0.0, 0.0, 1.0}, 0.0, precision(keeping.curvature_sd));
    for (std::size_t k = 0; k < keeping.num_keeping; ++k) {
      const double beyond = round == 0 ? 0.0 : std::abs(motion.d(k, x)) / (unusual * offset_sd);
      normal.add(motion.effects(k), -motion.drift[k], sample_weight / std::max(1.0, beyond));
    }
    x = normal.solution();
  }
  return x;
}

}  // namespace

EgoPath ego_path(const std::vector<double>& speed, const std::vector<double>& yaw_rate, double step,
                 const LaneKeeping& keeping) {
  const std::size_t size = speed.size();
  expects(size > 0 && yaw_rate.size() == size, "as many yaw rates as speeds, at least one");
  expects(step > 0.0, "step > 0");
  expects(keeping.bias_sd > 0.0 && keeping.curvature_sd > 0.0, "standard deviations > 0");
  expects(keeping.num_keeping <= size, "num_keeping at most the number of samples");

  const LinearMotion motion = linear_motion(speed, yaw_rate, step);
  const std::array<double, 4> x = most_likely(motion, step, keeping);
  EgoPath path{.gyro_bias = x[2], .curvature = x[3]};
  double sum = 0.0;
  for (std::size_t k = 0; k < size; ++k) {
    const double d = motion.d(k, x);
    const double heading =
        motion.turned[k] + x[1] - x[2] * step * static_cast<double>(k) - x[3] * motion.s[k];
    path.poses.push_back({motion.s[k], d, wrap_angle(heading)});
    sum += k < keeping.num_keeping ? d * d : 0.0;
  }
  path.keeping_rms =
      std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, keeping.num_keeping)));
  return path;
}

}  // namespace saca::scenario

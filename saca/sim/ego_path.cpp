#include "saca/sim/ego_path.h"

#include <algorithm>
#include <array>

#include "saca/core/angle.h"
#include "saca/core/contract.h"
#include "saca/traffic/series.h"

namespace saca::sim {

EgoPath ego_path(const std::vector<double>& speed, const std::vector<double>& yaw_rate, double step,
                 std::size_t num_keeping, bool curved) {
  const std::size_t size = speed.size();
  expects(size > 0 && yaw_rate.size() == size, "as many yaw rates as speeds, at least one");
  expects(step > 0.0, "step > 0");

  const std::vector<double> s = traffic::integral(speed, step);
  const std::vector<double> turned = traffic::integral(yaw_rate, step);
  // d = d0 + heading0 * s + drift + unknown * effect, to first order in the heading.
  std::vector<double> drift_rate(size);
  std::vector<double> effect_rate(size);
  for (std::size_t k = 0; k < size; ++k) {
    const double time = static_cast<double>(k) * step;
    drift_rate[k] = speed[k] * turned[k];
    effect_rate[k] = speed[k] * (curved ? -s[k] : -time);
  }
  const std::vector<double> drift = traffic::integral(drift_rate, step);
  const std::vector<double> effect = traffic::integral(effect_rate, step);

  constexpr double least_way = 20.0;  // [m]
  std::array<double, 3> x{};
  num_keeping = std::min(num_keeping, size);
  if (num_keeping > 0 && s[num_keeping - 1] >= least_way) {
    traffic::Normal3 normal;
    for (std::size_t k = 0; k < num_keeping; ++k) {
      normal.add({1.0, s[k], effect[k]}, -drift[k], 1.0);
    }
    x = normal.solution();
  }

  EgoPath path;
  (curved ? path.curvature : path.gyro_bias) = x[2];
  for (std::size_t k = 0; k < size; ++k) {
    const double heading =
        turned[k] + x[1] + (curved ? -x[2] * s[k] : -x[2] * step * static_cast<double>(k));
    path.poses.push_back(
        {s[k], drift[k] + x[0] + x[1] * s[k] + x[2] * effect[k], wrap_angle(heading)});
  }
  return path;
}

}  // namespace saca::sim

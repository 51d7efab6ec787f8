#pragma once

#include <cstddef>
#include <vector>

#include "saca/base/world/road.h"

namespace saca::scenario {

/// A car's way along its lane, from speed and yaw rate alone.
struct EgoPath {
  std::vector<world::LanePose> poses;  ///< s from 0
  double gyro_bias = 0.0;              ///< [rad/s]; yaw rate less bias is the truth
  double curvature = 0.0;              ///< of the lane [1/m]
  double keeping_rms = 0.0;            ///< of d while the lane is kept [m]
};

/// What is believed before the drive is looked at; standard deviations of normal laws, > 0.
struct LaneKeeping {
  std::size_t num_keeping = 0;   ///< in the first so many samples the driver keeps the lane
  double bias = 0.0;             ///< of the gyro, expected [rad/s]
  double bias_sd = 0.0087;       ///< [rad/s]
  double curvature_sd = 0.0005;  ///< of the lane, about 0 [1/m]
};

/// @param speed     [m/s], >= 0
/// @param yaw_rate  [rad/s], as many
/// @param step      [s], > 0
/// @throws ContractViolation  if sizes differ, there are no samples or a standard deviation is
///                            not > 0
///
/// With small angles the offset from the lane's middle follows from its value and the heading at
/// the start, the gyro's bias b and the lane's curvature k, linearly:
///
///     d' = v heading,   heading' = yaw_rate - b - k v.
///
/// The four are those with the largest posterior: while the lane is kept d is about 0, with the
/// standard deviation of lateral position that drivers have on the road (0.2 m; Verster and Roth,
/// Int. J. General Medicine 4, 2011), of which values 1.5 s apart tell something new (ours); the
/// heading at the start is about 0 with a standard deviation of 0.03 rad (ours). Samples beyond two
/// standard deviations count less (Huber), so that a short swerve does not bend the lane. At one
/// speed bias and curvature cannot be told apart by the drive; then the beliefs divide what is
/// seen. Mirror-symmetric.
[[nodiscard]] EgoPath ego_path(const std::vector<double>& speed,
                               const std::vector<double>& yaw_rate, double step,
                               const LaneKeeping& keeping);

}  // namespace saca::scenario

#pragma once

#include <vector>

#include "saca/world/road.h"

namespace saca::sim {

/// A car's way along its lane, from speed and yaw rate alone.
struct EgoPath {
  std::vector<world::LanePose> poses;  ///< s from 0
  double gyro_bias = 0.0;              ///< [rad/s]; yaw rate less bias is the truth
  double curvature = 0.0;              ///< of the lane [1/m]
};

/// @param speed        [m/s], >= 0
/// @param yaw_rate     [rad/s], as many
/// @param step         [s], > 0
/// @param num_keeping  the first so many samples, in which the driver keeps the middle of the lane
/// @param curved       whether the lane is an arc, its curvature unknown and the gyro without bias;
///                     else it is straight and the bias unknown
/// @throws ContractViolation  if sizes differ or there are no samples
///
/// With small angles d'' follows from speed and yaw rate; d and heading at the start and the
/// unknown are those with the least sum of d^2 over the samples in which the lane is kept. Less
/// than 20 m of way in these fixes nothing: then all three are 0.
[[nodiscard]] EgoPath ego_path(const std::vector<double>& speed,
                               const std::vector<double>& yaw_rate, double step,
                               std::size_t num_keeping, bool curved);

}  // namespace saca::sim

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "saca/lab/recordings/hundred_car_file.h"
#include "saca/lab/scenario/ego_path.h"

namespace saca::importers {

/// Rows of an event, as indices.
struct RowRange {
  std::size_t first = 0;
  std::size_t last = 0;  ///< >= first
  [[nodiscard]] std::size_t size() const { return last - first + 1; }
};

/// What an event's rows tell of the gyro's bias before the drive is fitted to a lane: a normal law.
struct GyroBelief {
  double bias = 0.0;  ///< [rad/s]
  double sd = 0.0;    ///< [rad/s], > 0
};

/// Where the car stands for 2.5 s or more the yaw rate is the bias, to 0.1 deg/s (it is recorded in
/// steps of 0.16). Else, on a road that the study calls straight, its median while the car goes
/// faster than 5 m/s, to 0.3 deg/s, if it is less than 1.5 deg/s (the release's is up to about 1);
/// on a curve nothing is known but that size: 0, to 0.5 deg/s.
/// @param curved  whether the study calls the road a curve
[[nodiscard]] GyroBelief gyro_belief(const std::vector<recordings::HundredCarRow>& rows,
                                     bool curved);

/// The ego's measured motion in the rows of a scenario, treated, and its lane.
struct EgoMotion {
  std::vector<double> speed;          ///< [m/s]
  std::vector<double> yaw_rate;       ///< without the bias [rad/s]
  std::size_t num_speed_missing = 0;  ///< of the rows of the scenario
  scenario::EgoPath path;             ///< s from 0 at the scenario's first row
  double largest_offset = 0.0;        ///< |d| in the rows in which the lane is kept [m]
};

/// @param kept    rows in which the driver is taken to keep the lane: they begin where the
///                scenario does or before, and end no later than it
/// @param window  rows of the scenario
/// @param curved  whether the study calls the road a curve
/// @return        nullopt when speed or yaw rate are missing for more than 1.5 s on end, or both
///                together have less than 1.6 s
///
/// Held values of speed are interpolated and fitted by a line over +-0.5 s; jolts are taken out of
/// the yaw rate. The lane comes of the rows in which it is kept alone (ego_path.h), with a standard
/// deviation of the curvature of 1/2000 m where the study calls the road straight and of 1/200 m
/// where it says curve (ours).
[[nodiscard]] std::optional<EgoMotion> ego_motion(
    const std::vector<recordings::HundredCarRow>& rows, const RowRange& kept,
    const RowRange& window, bool curved);

}  // namespace saca::importers

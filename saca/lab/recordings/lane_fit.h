#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/road.h"
#include "saca/lab/recordings/commonroad.h"

namespace saca::recordings {

/// A lane of a map as the library's one arc, and how well that fits.
struct LaneFit {
  world::Road road;                    ///< s = 0 beside the start
  std::vector<std::int64_t> lanelets;  ///< that the arc was fitted to, in driving order
  double behind = 0.0;                 ///< the fit's stretch: from -behind to `ahead` [m]
  double ahead = 0.0;
  double rms = 0.0;      ///< distance of the centre line from the arc [m]
  double largest = 0.0;  ///< likewise, at most [m]
};

/// The lane in which somebody starts, as an arc of constant curvature.
///
/// @param start_W  pose at the start: it is in a lanelet, or within 0.5 m of one, that leads within
///                 60 deg of its heading
/// @param way_W    where it goes; empty when nobody knows. Of lanelets that overlap or fork the one
///                 that holds more of these points is taken, then the nearest or straightest
/// @return         Error::Code::out_of_range when there is no such lanelet, less than 15 m of lane
///                 ahead, a lane narrower than 2 m or wider than 8 m, a curve tighter than 5 m, or
///                 an arc that misses the lane's centre by more than 1 m
///
/// Least squares over points of the centre line 1 m apart, from 20 m behind to 100 m ahead; while
/// one lies more than 0.3 m off, on a shorter stretch, down to 7.5 m behind and 15 m ahead. Lane
/// width and the road's edges are medians over the same points; the edges are the outer bounds of
/// the last lanelets to the left and right, oncoming ones included.
[[nodiscard]] Result<LaneFit> fit_lane(const CommonRoad& file, const Pose& start_W,
                                       std::span<const Vec2> way_W);

}  // namespace saca::recordings

#pragma once

#include <cmath>

#include "saca/base/core/pose.h"
#include "saca/base/core/units.h"

namespace saca::scenario {

// Numbers as scenario files hold what was recorded: the noise has no more digits.

inline double rounded(double value, double unit_parts) {
  return std::round(value * unit_parts) / unit_parts;
}
inline double rounded_mm(double value) {
  return rounded(value, 1000.0);
}
/// To 0.01 degrees.
inline double rounded_angle(double angle) {
  return from_degrees(rounded(to_degrees(angle), 100.0));
}
inline Pose rounded_pose(const Pose& X) {
  return {{rounded_mm(X.p.x), rounded_mm(X.p.y)}, rounded_angle(X.yaw)};
}

}  // namespace saca::scenario

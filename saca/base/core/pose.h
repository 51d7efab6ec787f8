#pragma once

#include "saca/base/core/angle.h"
#include "saca/base/core/vec2.h"

namespace saca {

/// Where one frame stands in another: `Pose X_WB` is B seen from W. Neighbouring letters match:
/// `X_WB = X_WL * X_LB`, `p_W = X_WB * p_B`.
struct Pose {
  Vec2 p;            ///< origin of the inner frame, expressed in the outer one [m]
  double yaw = 0.0;  ///< of the inner x axis, counter-clockwise from the outer one [rad]
  friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

inline Vec2 operator*(const Pose& X_WB, Vec2 p_B) {
  return X_WB.p + rotated(p_B, X_WB.yaw);
}
inline Pose operator*(const Pose& X_WL, const Pose& X_LB) {
  return {X_WL * X_LB.p, wrap_angle(X_WL.yaw + X_LB.yaw)};
}
/// W seen from B.
inline Pose inverse(const Pose& X_WB) {
  return {rotated(-X_WB.p, -X_WB.yaw), wrap_angle(-X_WB.yaw)};
}
/// On the way from `a` to `b`: position linear, yaw along the shorter arc. `share` 0 gives `a`, 1
/// `b`.
inline Pose between(const Pose& a, const Pose& b, double share) {
  return {a.p + share * (b.p - a.p), wrap_angle(a.yaw + share * wrap_angle(b.yaw - a.yaw))};
}
inline bool is_finite(const Pose& X) {
  return is_finite(X.p) && std::isfinite(X.yaw);
}

}  // namespace saca

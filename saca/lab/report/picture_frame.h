#pragma once

#include <algorithm>
#include <limits>

#include "saca/base/core/pose.h"
#include "saca/lab/report/svg.h"

namespace saca::report {

/// A rectangle along the axes.
struct Extent {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] Vec2 middle() const { return 0.5 * (low + high); }
  [[nodiscard]] Vec2 size() const { return high - low; }
  [[nodiscard]] Extent grown(Vec2 by) const { return {low - by, high + by}; }
  [[nodiscard]] bool meets(const Extent& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y;
  }
  [[nodiscard]] Vec2 nearest(Vec2 p) const {
    return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y)};
  }
};

/// Where W lies in a picture: P is the plan turned so that the lane at the ego points to the right.
struct PictureFrame {
  Pose X_PW;
  Extent seen_P;       ///< what the picture shows [m]
  double scale = 1.0;  ///< [px/m]

  [[nodiscard]] Vec2 px(Vec2 p_W) const {
    const Vec2 p_P = X_PW * p_W;
    return {scale * (p_P.x - seen_P.low.x), scale * (seen_P.high.y - p_P.y)};
  }
  [[nodiscard]] SvgSize size() const { return {scale * seen_P.size().x, scale * seen_P.size().y}; }
};

/// The frame of that size that shows at least `wanted_P`, in its middle.
[[nodiscard]] inline PictureFrame framed(const Pose& X_PW, const Extent& wanted_P, SvgSize size) {
  const Vec2 wanted = wanted_P.size();
  const double scale = std::min(size.width / wanted.x, size.height / wanted.y);
  const Vec2 half{size.width / scale / 2.0, size.height / scale / 2.0};
  const Vec2 middle = wanted_P.middle();
  return {X_PW, {middle - half, middle + half}, scale};
}

}  // namespace saca::report

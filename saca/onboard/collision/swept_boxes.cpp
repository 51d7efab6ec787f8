#include "saca/onboard/collision/swept_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace saca::collision {
namespace {

using world::Footprint;

// Poses of a part, less one. With fewer there are more parts to compare, with more they overlap
// where the bodies are far from meeting.
constexpr std::size_t segments_per_part = 4;

// What rounding may move a body, here and in the exact search [m].
constexpr double margin = 1e-6;

constexpr double diagonal = 0.5 * std::numbers::sqrt2;

// Coordinates of a point along (1, 0), (0, 1) and the two diagonals.
std::array<double, 4> along_each(Vec2 p) {
  return {p.x, p.y, diagonal * (p.x + p.y), diagonal * (p.x - p.y)};
}

// A rectangle about the footprint that points somewhere, seen along the four directions.
struct Extent {
  std::array<double, 4> centre;  ///< from the body's origin [m]
  std::array<double, 4> half;    ///< [m]
};
Extent extent(const Footprint& footprint, double yaw) {
  const Vec2 half = half_axes(footprint);
  const Vec2 ahead = rotated({1.0, 0.0}, yaw);
  const std::array<double, 4> along = along_each(ahead);
  const std::array<double, 4> across = along_each({-ahead.y, ahead.x});
  Extent all{.centre = along_each(footprint.centre_x * ahead), .half = {}};
  for (std::size_t k = 0; k < 4; ++k) {
    all.half[k] = half.x * std::abs(along[k]) + half.y * std::abs(across[k]);
  }
  return all;
}

}  // namespace

SweptBoxes::SweptBoxes(const Footprint& footprint, const world::Track& X_WA)
    : start_(X_WA.start), span_(X_WA.step * static_cast<double>(segments_per_part)) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const auto& poses = X_WA.X_WA;
  const std::size_t last = poses.size() - 1;
  const double reach = bounding_radius(footprint);
  all_.low.fill(endless);
  all_.high.fill(-endless);
  parts_.reserve(last / segments_per_part + 1);
  double yaw = poses.front().yaw;
  Extent body = extent(footprint, yaw);
  for (std::size_t begin = 0; parts_.empty() || begin < last; begin += segments_per_part) {
    const std::size_t end = std::min(begin + segments_per_part, last);
    std::array<double, 4> low;
    std::array<double, 4> high;
    low.fill(endless);
    high.fill(-endless);
    double most_turned = 0.0;  // from one pose to the next [rad]
    for (std::size_t i = begin; i <= end; ++i) {
      if (poses[i].yaw != yaw) {
        most_turned = std::max(most_turned, std::abs(wrap_angle(poses[i].yaw - yaw)));
        yaw = poses[i].yaw;
        body = extent(footprint, yaw);
      }
      const std::array<double, 4> origin = along_each(poses[i].p);
      for (std::size_t k = 0; k < 4; ++k) {
        const double centre = origin[k] + body.centre[k];
        low[k] = std::min(low[k], centre - body.half[k]);
        high[k] = std::max(high[k], centre + body.half[k]);
      }
    }
    // While the body turns by an angle t, a point r from its origin leaves the straight line
    // between its ends by r (1 - cos(t / 2)) <= r t^2 / 8.
    const double more = 0.125 * reach * most_turned * most_turned + margin;
    for (std::size_t k = 0; k < 4; ++k) {
      low[k] -= more;
      high[k] += more;
      all_.low[k] = std::min(all_.low[k], low[k]);
      all_.high[k] = std::max(all_.high[k], high[k]);
    }
    parts_.push_back({low, high});
  }
}

bool SweptBoxes::are_near(const Octagon& a, const Octagon& b, double distance) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (a.low[k] - b.high[k] > distance || b.low[k] - a.high[k] > distance) {
      return false;
    }
  }
  return true;
}

std::size_t SweptBoxes::part_at(double time) const {
  const auto last = static_cast<double>(parts_.size() - 1);
  return static_cast<std::size_t>(std::clamp((time - start_) / span_, 0.0, last));
}

double SweptBoxes::end_of(std::size_t part) const {
  return part + 1 < parts_.size() ? start_ + static_cast<double>(part + 1) * span_
                                  : std::numeric_limits<double>::infinity();
}

bool may_come_near(const SweptBoxes& a, const SweptBoxes& b, double start, double end,
                   double distance) {
  if (!SweptBoxes::are_near(a.all_, b.all_, distance)) {
    return false;
  }
  std::size_t i = a.part_at(start);
  std::size_t j = b.part_at(start);
  while (!SweptBoxes::are_near(a.parts_[i], b.parts_[j], distance)) {
    const double end_a = a.end_of(i);
    const double end_b = b.end_of(j);
    if (std::min(end_a, end_b) >= end) {
      return false;
    }
    i += end_a <= end_b ? 1 : 0;
    j += end_b <= end_a ? 1 : 0;
  }
  return true;
}

}  // namespace saca::collision

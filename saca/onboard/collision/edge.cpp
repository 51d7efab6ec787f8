#include "saca/onboard/collision/edge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/gap.h"

namespace saca::collision {
namespace {

using world::Footprint;
using world::Road;

// Below this curvature 300 m of road bend by less than 0.05 mm [1/m].
constexpr double straight = 1e-9;

// Point of the footprint farthest from a centre. For a box it is a corner; on an ellipse the point
// whose normal points away from the centre, found by repeating: distances never shrink.
Vec2 farthest_from(Vec2 centre_W, const Footprint& footprint, const Pose& X_WB) {
  if (footprint.shape != world::Shape::ellipse) {
    const Vec2 half = half_axes(footprint);
    Vec2 farthest = X_WB * Vec2{footprint.centre_x, 0.0};
    for (const Vec2 corner : {Vec2{1, 1}, Vec2{-1, 1}, Vec2{-1, -1}, Vec2{1, -1}}) {
      const Vec2 p_W = X_WB * Vec2{footprint.centre_x + half.x * corner.x, half.y * corner.y};
      if (norm(p_W - centre_W) > norm(farthest - centre_W)) {
        farthest = p_W;
      }
    }
    return farthest;
  }
  Vec2 p_W = X_WB * Vec2{footprint.centre_x, 0.0};
  for (int i = 0; i < 30 && norm(p_W - centre_W) > 0.0; ++i) {
    p_W = support(footprint, X_WB, p_W - centre_W);
  }
  return p_W;
}

// A pin so thin that its size does not matter stands for a point.
Vec2 nearest_to(Vec2 centre_W, const Footprint& footprint, const Pose& X_WB) {
  const Footprint pin{.shape = world::Shape::ellipse, .length = 1e-9, .width = 1e-9};
  const world::Separation gap = separation(footprint, X_WB, pin, {centre_W, 0.0});
  return gap.distance > 0.0 ? gap.p_a_W : centre_W;
}

/// Bounds from below of what is left to an edge: quickly found, and enough where the edge is far.
class ClearanceBound {
 public:
  ClearanceBound(const Road& road, Side side, const Footprint& footprint)
      : curvature_(road.curvature),
        origin_(road.X_WL.p),
        along_(rotated({1.0, 0.0}, road.X_WL.yaw)),
        outwards_(side == Side::left ? 1.0 : -1.0),
        edge_(side == Side::left ? road.left_edge : road.right_edge),
        half_(half_axes(footprint)),
        centre_x_(footprint.centre_x),
        reach_(norm(half_ + Vec2{std::abs(centre_x_), 0.0})) {}

  [[nodiscard]] double at(const Pose& X_WB) const {
    const Vec2 from_origin = X_WB.p - origin_;
    const Vec2 p{dot(along_, from_origin), dot(left_of(along_), from_origin)};
    // The lane's direction beside the body, as in world::to_lane.
    const Vec2 to_centre{1.0 - curvature_ * p.y, curvature_ * p.x};
    const double r = std::sqrt(dot(to_centre, to_centre));
    const double d = (2.0 * p.y - curvature_ * dot(p, p)) / (1.0 + r);
    if (std::abs(curvature_) * (std::abs(d) + reach_) > 0.5) {
      return -std::numeric_limits<double>::infinity();
    }
    const Vec2 heading = rotated({1.0, 0.0}, X_WB.yaw);
    const Vec2 in_road{dot(along_, heading), dot(left_of(along_), heading)};
    const double cosine = dot(in_road, to_centre) / r;
    const double sine = dot(left_of(to_centre), in_road) / r;
    // A point that lies a ahead of the body is less than curvature a^2 nearer to an edge for that.
    const double sideways = outwards_ * centre_x_ * sine + std::abs(half_.x * sine) +
                            std::abs(half_.y * cosine) + std::abs(curvature_) * reach_ * reach_;
    return outwards_ * (edge_ - d) - sideways;
  }

  /// By how much it may be less on the way from one pose to the next.
  [[nodiscard]] double between(const Pose& a, const Pose& b) const {
    const double way = std::sqrt(dot(b.p - a.p, b.p - a.p));
    const double bend = 2.0 * std::abs(curvature_) * way;  // of the lane, at most
    const double turn = std::abs(wrap_angle(b.yaw - a.yaw)) + bend;
    return 0.125 * (reach_ * turn * turn + bend * way) + 1e-6;
  }

 private:
  double curvature_;
  Vec2 origin_;
  Vec2 along_;
  double outwards_;
  double edge_;
  Vec2 half_;
  double centre_x_;
  double reach_;
};

/// Whether a body on a track is so far from an edge that it need not be looked at closely.
class TrackBounds {
 public:
  /// @param parts  looks from one pose of the track to the next; all of it outlives the bounds
  TrackBounds(const ClearanceBound& least, const world::Track& track, int parts)
      : least_(least), track_(track), parts_(parts) {}

  /// All that is left of the way to the next pose is farther from the edge than that.
  bool is_far(int look, double clearance) {
    const std::size_t pose = std::min(static_cast<std::size_t>(look / parts_), last_pose());
    if (!bound_ || pose != bounded_) {
      const bool goes_on = bound_ && pose == bounded_ + 1;
      const Pose& here = track_.X_WA[pose];
      const Pose& next = track_.X_WA[std::min(pose + 1, last_pose())];
      const double now = goes_on ? at_next_ : least_.at(here);
      at_next_ = least_.at(next);
      bounded_ = pose;
      bound_ = std::min(now, at_next_) - least_.between(here, next);
    }
    return *bound_ > clearance;
  }
  /// The last look before the next pose.
  [[nodiscard]] int last_on_way(int look) const { return (look / parts_ + 1) * parts_ - 1; }

 private:
  [[nodiscard]] std::size_t last_pose() const { return track_.X_WA.size() - 1; }

  const ClearanceBound& least_;
  const world::Track& track_;
  int parts_;
  std::size_t bounded_ = 0;      ///< the pose whose way to the next is bounded
  double at_next_ = 0.0;         ///< the bound at the pose after it, with which the next way begins
  std::optional<double> bound_;  ///< all the way
};

}  // namespace

Vec2 outermost(const Road& road, Side side, const Footprint& footprint, const Pose& X_WB) {
  const double outwards = side == Side::left ? 1.0 : -1.0;
  if (std::abs(road.curvature) < straight) {
    return support(footprint, X_WB, rotated({0.0, outwards}, road.X_WL.yaw));
  }
  const Vec2 centre_W = road.X_WL * Vec2{0.0, 1.0 / road.curvature};
  return outwards * road.curvature > 0.0 ? nearest_to(centre_W, footprint, X_WB)
                                         : farthest_from(centre_W, footprint, X_WB);
}

double edge_clearance(const Road& road, Side side, const Footprint& footprint, const Pose& X_WB) {
  expects(road.left_edge > 0.0 && road.right_edge < 0.0, "left_edge > 0 > right_edge");
  expects(std::isfinite(road.curvature), "curvature is finite");
  const double d = to_lane(road, {outermost(road, side, footprint, X_WB), 0.0}).d;
  return side == Side::left ? road.left_edge - d : d - road.right_edge;
}

EdgeApproach edge_approach(const Road& road, Side side, const Footprint& footprint,
                           const world::Track& track, double of_interest, double from) {
  expects(!track.X_WA.empty() && track.step > 0.0, "a track has at least one pose");
  const auto clearance_at = [&](double time) {
    return edge_clearance(road, side, footprint, pose_at(track, time));
  };
  // Between poses 10 ms apart the clearance bends by less than v^2 k dt^2 / 8 < 0.3 mm.
  const int parts = std::max(1, static_cast<int>(std::ceil(track.step / 0.0101)));
  const int steps = parts * static_cast<int>(track.X_WA.size() - 1);
  const double step = track.step / parts;
  const ClearanceBound least(road, side, footprint);
  TrackBounds bounds(least, track, parts);
  EdgeApproach found{.clearance = of_interest};
  const double begin = std::max(from, track.start);
  double inside = begin;
  const int first = static_cast<int>(std::min((begin - track.start) / step, double(steps)));
  for (int i = first; i <= steps; ++i) {
    if (i > first && bounds.is_far(i, found.clearance)) {
      i = std::min(steps, bounds.last_on_way(i));
      inside = track.start + i * step;
      continue;
    }
    const double time = i == first ? begin : track.start + i * step;
    const double now = clearance_at(time);
    if (now < found.clearance) {
      found.clearance = now;
      found.nearest_at = time;
    }
    if (now > 0.0) {
      inside = time;
      continue;
    }
    double beyond = time;
    for (int k = 0; k < 30 && i > first; ++k) {
      const double middle = 0.5 * (inside + beyond);
      (clearance_at(middle) > 0.0 ? inside : beyond) = middle;
    }
    found.crossing = beyond;
    return found;
  }
  return found;
}

}  // namespace saca::collision

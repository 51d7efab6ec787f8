#include "saca/outcome/edge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "saca/core/contract.h"

namespace saca::outcome {
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

/// What is left to an edge at each pose at least, however the body is turned: quickly found, and
/// enough where the edge is far.
std::vector<double> least_rooms(const Road& road, Side side, const Footprint& footprint,
                                const world::Track& track) {
  const double reach = norm(half_axes(footprint) + Vec2{std::abs(footprint.centre_x), 0.0});
  std::vector<double> rooms(track.X_WA.size());
  std::transform(track.X_WA.begin(), track.X_WA.end(), rooms.begin(), [&](const Pose& X_WB) {
    const double d = to_lane(road, X_WB).d;
    return (side == Side::left ? road.left_edge - d : d - road.right_edge) - reach;
  });
  return rooms;
}

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

double room(const Road& road, Side side, const Footprint& footprint, const Pose& X_WB) {
  expects(road.left_edge > 0.0 && road.right_edge < 0.0, "left_edge > 0 > right_edge");
  expects(std::isfinite(road.curvature), "curvature is finite");
  const double d = to_lane(road, {outermost(road, side, footprint, X_WB), 0.0}).d;
  return side == Side::left ? road.left_edge - d : d - road.right_edge;
}

EdgeApproach edge_approach(const Road& road, Side side, const Footprint& footprint,
                           const world::Track& track, double of_interest, double from) {
  expects(!track.X_WA.empty() && track.step > 0.0, "a track has at least one pose");
  const auto room_at = [&](double time) {
    return room(road, side, footprint, pose_at(track, time));
  };
  // Between poses 10 ms apart the room bends by less than v^2 k dt^2 / 8 < 0.3 mm.
  const int parts = std::max(1, static_cast<int>(std::ceil(track.step / 0.0101)));
  const int steps = parts * static_cast<int>(track.X_WA.size() - 1);
  const double step = track.step / parts;
  const std::vector<double> least = least_rooms(road, side, footprint, track);
  constexpr double bend = 0.01;  // [m] by which it can be less between two poses
  const auto is_far = [&](int i, double room) {
    const auto pose = static_cast<std::size_t>(i / parts);
    return std::min(least[pose], least[std::min(pose + 1, least.size() - 1)]) - bend > room;
  };
  EdgeApproach found{std::nullopt, of_interest};
  const double begin = std::max(from, track.start);
  double inside = begin;
  const int first = static_cast<int>(std::min((begin - track.start) / step, double(steps)));
  for (int i = first; i <= steps; ++i) {
    const double time = i == first ? begin : track.start + i * step;
    if (i > first && is_far(i, found.room)) {
      inside = time;
      continue;
    }
    const double now = room_at(time);
    found.room = std::min(found.room, now);
    if (now > 0.0) {
      inside = time;
      continue;
    }
    double beyond = time;
    for (int k = 0; k < 30 && i > first; ++k) {
      const double middle = 0.5 * (inside + beyond);
      (room_at(middle) > 0.0 ? inside : beyond) = middle;
    }
    found.crossing = beyond;
    return found;
  }
  return found;
}

}  // namespace saca::outcome

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "saca/base/core/pose.h"
#include "saca/lab/recordings/commonroad.h"

namespace saca::recordings {

/// A body seen from one lanelet of a map.
struct LanePlace {
  std::size_t lanelet = 0;  ///< index into LaneMap::lanelets
  double along = 0.0;       ///< of the nearest point of the centre line, from its beginning [m]
  double offset = 0.0;      ///< of the body's centre, > 0 to the left of the centre line [m]
  double heading = 0.0;     ///< of the body against the lane, in (-pi, pi] [rad]
  double width = 0.0;       ///< of the lane there [m]
  double curvature = 0.0;   ///< of the centre line there, > 0 to the left [1/m]
};

/// One instant of a body that is followed through the lanes.
struct LaneSighting {
  std::optional<LanePlace> place;  ///< nullopt: in no lane that leads its way
  int lane_step = 0;               ///< +1: crossed into the left neighbour since the one before
};

/// How far beyond the bound a body is still kept in the lane where it was [m]: noise of the
/// recordings, so that one that drives along a bound does not change lanes at every sample. Ours.
constexpr double lane_hold = 0.3;

/// The lanes of a map, for looking up bodies in them.
///
/// Centre lines are sampled a metre apart (farther in lanelets of more than 5 km) and run on into
/// the straightest predecessor and successor, so that headings and curvatures do not end with a
/// lanelet. A heading is the direction over 3 m to either side, a curvature the change of heading
/// over 10 m to either side: corners of the map are rounded off, and a curve tighter than 20 m of
/// length is blunted.
class LaneMap {
 public:
  explicit LaneMap(const CommonRoad& file);

  /// A centre line at stations a metre apart or less.
  struct Line {
    std::int64_t id = 0;
    std::vector<Vec2> points_W;
    std::vector<double> along;      ///< [m], from 0
    std::vector<double> heading;    ///< unwrapped [rad]
    std::vector<double> curvature;  ///< [1/m]
    std::vector<double> width;      ///< [m]
    std::vector<std::size_t> predecessors;
    std::vector<std::size_t> successors;
    std::optional<std::size_t> left;  ///< neighbour of the same direction
    std::optional<std::size_t> right;
    Vec2 low_W;  ///< a box around the lane [m]
    Vec2 high_W;
    [[nodiscard]] double length() const { return along.back(); }
  };
  [[nodiscard]] const std::vector<Line>& lanelets() const { return lines_; }

  /// All lanelets that hold the body's centre and lead within 60 deg of its heading, the one whose
  /// centre is nearest first.
  /// @param beyond  how far outside a bound still counts [m]
  [[nodiscard]] std::vector<LanePlace> places(const Pose& X_WA, double beyond = 0.0) const;

  /// Follows a body: it stays in its lane (that is, the lanelet or one after it) while it is within
  /// lane_hold of it, then goes to the neighbour that holds it, or else is looked up anew. A lane
  /// found anew that lies right beside the old one, within 0.5 m and 10 deg, counts as its
  /// neighbour: maps do not name all.
  /// @param before  where it was; nullopt: nowhere
  [[nodiscard]] LaneSighting follow(const std::optional<LanePlace>& before, const Pose& X_WA) const;

  /// A lanelet ahead on a lane, and the way to its beginning [m], < 0 for the one we are in.
  struct Ahead {
    std::size_t lanelet = 0;
    double way = 0.0;
  };
  /// The lanelets along the lane from a place on, at forks all of them, and how far the map goes
  /// on.
  struct Way {
    std::vector<Ahead> lanelets;
    double end = 0.0;  ///< where the first of the branches ends [m], at most `reach`
  };
  [[nodiscard]] Way way_ahead(const LanePlace& from, double reach) const;

 private:
  /// The lanelet and what follows it, a few lanelets far.
  [[nodiscard]] std::vector<std::size_t> lane_from(std::size_t lanelet) const;
  [[nodiscard]] std::optional<LanePlace> place_in(std::size_t lanelet, const Pose& X_WA,
                                                  double beyond) const;

  std::vector<Line> lines_;
};

}  // namespace saca::recordings

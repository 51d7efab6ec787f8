#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/pose.h"
#include "saca/base/core/result.h"
#include "saca/base/world/footprint.h"

namespace saca::recordings {

// Recorded traffic with its map, as CommonRoad files hold it. Source of elements, units and frames:
// CommonRoad: Documentation of the XML Format, version 2020a, Technical University of Munich.

/// The lane beside a lanelet.
struct Neighbour {
  std::int64_t lanelet = 0;
  bool same_direction = true;
};

/// A piece of a lane.
struct Lanelet {
  std::int64_t id = 0;
  std::vector<Vec2> left_W;   ///< left bound along the driving direction [m], two points or more
  std::vector<Vec2> right_W;  ///< right bound, as many points: they face each other
  std::vector<std::int64_t> predecessors;
  std::vector<std::int64_t> successors;
  std::optional<Neighbour> left;
  std::optional<Neighbour> right;
};

/// One instant of an obstacle.
struct ObstacleState {
  std::int64_t step = 0;  ///< time over CommonRoad::time_step, >= 0
  Pose X_WO;              ///< O: the frame in which the obstacle's shape stands
  double speed = 0.0;     ///< along its heading [m/s]; < 0 reverses
};

/// A body that was recorded, or that stands there.
struct Obstacle {
  std::int64_t id = 0;
  bool dynamic = true;
  std::string type;  ///< the format's word: car, truck, parkedVehicle, ...
  world::Footprint footprint;
  Pose X_OA;                          ///< the shape's centre, along the shape
  std::vector<ObstacleState> states;  ///< at least one; steps grow; one of a static obstacle
};

/// Where somebody is to drive from.
struct PlanningProblem {
  std::int64_t id = 0;
  ObstacleState start;
};

/// A file of recorded traffic.
struct CommonRoad {
  std::string benchmark;  ///< the file's own name for itself
  std::string author;
  std::string affiliation;
  std::string source;
  double time_step = 0.1;  ///< [s], > 0
  std::optional<double> latitude_deg;
  std::optional<double> longitude_deg;
  std::vector<std::string> tags;
  std::vector<Lanelet> lanelets;  ///< at least one; all that they name exist
  std::vector<Obstacle> obstacles;
  std::vector<PlanningProblem> problems;
  /// How many elements of a kind were passed over, by `parent/element`: what is not named above,
  /// lanes that name no lanelet of the file, obstacles that are neither one rectangle nor one disc.
  std::map<std::string, std::size_t> ignored;
};

/// @param source  name for messages, usually the path
/// @return        Error::Code::malformed or out_of_range, naming source, line, element, wanted and
///                got. Refused are other versions, states that are no exact numbers, steps out of
///                order, an id given twice, a file without lanelets, and set-based predictions
///                (SPOT, occupancy sets): they are no recordings.
[[nodiscard]] Result<CommonRoad> read_commonroad(std::string_view text, std::string_view source);

/// Whether a file's `source` says that it holds set-based predictions (SPOT): no recording, though
/// nothing is wrong with it. False for what is no XML.
[[nodiscard]] bool is_set_based(std::string_view text);

/// @return  nullptr when there is none
[[nodiscard]] const Lanelet* find_lanelet(const CommonRoad& file, std::int64_t id);

}  // namespace saca::recordings

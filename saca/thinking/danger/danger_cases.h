#pragma once

#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/danger.h"

namespace saca::danger {

/// A kind of obstacle that is to be judged, and how fast it may become on which grip.
struct ObstacleKind {
  world::Footprint obstacle;
  double top_speed = 0.0;  ///< [m/s], >= 0
};

/// A table that a `DangerModel` is to have.
struct DangerCase {
  std::string name;     ///< of its file: body and speed, e.g. "car_10mps"
  AvoidanceCase asked;  ///< with a text like that of a case in data/reach
};

/// The tables with which these obstacles can be judged: for each, those of the standard body
/// nearest to it (person or cycle, car, truck, articulated truck) at rest and in steps of speed up
/// to 1 m/s beyond its top speed, as perception or a forecast may have it. Each has 0.58 million
/// cells and takes seconds to solve. No table is of an obstacle beyond `fastest_obstacle`, which
/// the top speed may be on little grip: such meetings are judged by a few evasions (danger.h).
///
/// The steps, and the cells: docs/decisions/0014 has what they cost in accuracy.
/// @param car   of the ego; its grip is that of the tables
/// @param grip  of the road on which they are to serve: on less than the tables' a speed counts for
///              more [-], > 0
/// @return      Error::Code::malformed, naming what is wanted, for a car or an ego beyond what a
///              case may hold
[[nodiscard]] Result<std::vector<DangerCase>> danger_cases(const Avoidance& car,
                                                           const world::Footprint& ego, double grip,
                                                           std::span<const ObstacleKind> wanted);

}  // namespace saca::danger

#pragma once

#include <cstddef>
#include <optional>

#include "saca/base/world/footprint.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/edge.h"

namespace saca::importers {

/// The recorded ego touches a body.
struct RecordedTouch {
  double time = 0.0;      ///< of the first look at which they touch [s]
  std::size_t actor = 0;  ///< index into scenario.actors
};

/// The recorded ego reaches beyond an edge of the road.
struct RecordedDeparture {
  double time = 0.0;  ///< of the first look at which it does [s]
  collision::Side side = collision::Side::right;
  double beyond = 0.0;  ///< by how much at most, until the drive ends or somebody is touched [m]
};

/// What a recorded drive, as it was rebuilt, leads to.
struct RecordedDrive {
  std::optional<RecordedTouch> touch;          ///< the first
  std::optional<RecordedDeparture> departure;  ///< before that
};

/// Follows the recorded ego through its recording and looks every 20 ms. An actor is there from its
/// first sample to its last, since what it does beyond is a guess; one that has no recording is not
/// looked at, nor a ghost. After a touch nothing is looked at.
/// @param ego  body about its centre of mass
/// @throws ContractViolation  if the ego has no recording of two samples or more, or a pose is not
///                            finite
[[nodiscard]] RecordedDrive recorded_drive(const scenario::Scenario& scenario,
                                           const world::Footprint& ego);

}  // namespace saca::importers

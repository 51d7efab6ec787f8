#pragma once

#include "saca/lab/scenario/scenario.h"

namespace saca::scenario {

/// A way that goes straight, turns on an arc of a circle and goes straight on, driven at a constant
/// speed. It stands still in a frame whose origin is where the arc begins.
struct Turn {
  double heading = 0.0;  ///< before the arc [rad]
  double angle = 0.0;    ///< of the arc, > 0 to the left [rad]; not 0
  double radius = 10.0;  ///< of the arc [m], > 0

  [[nodiscard]] double arc_length() const;
  /// @param along  the way made since the arc began [m]; < 0: before it
  [[nodiscard]] Pose pose(double along) const;
};

/// The turn as a recording from 0 s on.
///
/// @param begins    where the arc begins, in W [m]; the turn's heading is in W
/// @param at_arc    when the arc begins [s]; may be less than 0
/// @param speed     [m/s], > 0
/// @param duration  [s], > 0
[[nodiscard]] Recording recording_of(const Turn& turn, Vec2 begins, double at_arc, double speed,
                                     double duration);

}  // namespace saca::scenario

#pragma once

#include "saca/lab/scenario/scenario.h"

namespace saca::importers {

/// A road elsewhere, in the digits of a scenario's file: mm, 0.01 degrees, 1e-6 / m.
[[nodiscard]] world::Road moved_road(const world::Road& road, Vec2 way_W);

/// The scenario's road with its edges moved out to 0.2 m beyond every vehicle, the ego's included,
/// that is recorded with its centre between them: ground on which somebody drove is road, whatever
/// the map says.
///
/// @param behind  [m]; who is outside of s = -behind to `ahead` does not count: the road is an arc
/// @param ahead   [m]
/// @throws ContractViolation  if an actor has no recording
[[nodiscard]] world::Road widened_road(const scenario::Scenario& scenario, double behind,
                                       double ahead);

}  // namespace saca::importers

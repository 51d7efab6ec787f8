#pragma once

#include <cstddef>

#include "saca/sim/scenario.h"
#include "saca/world/track.h"

namespace saca::sim {

/// The true motion of an actor over the whole scenario.
///
/// @param actor  index into scenario.actors
/// @param step   [s], > 0
/// @return       from 0, or from the actor's first sample when that is later (before it, the actor
///               is not there), to scenario.duration
/// @throws ContractViolation  outside these ranges
///
/// A recording is interpolated. After its end the actor goes on straight at its last speed; slower
/// than 0.3 m/s counts as stopped.
[[nodiscard]] world::Track actor_track(const Scenario& scenario, std::size_t actor, double step);

/// The ego as the scenario gives it, before anyone else drives: recorded, or going on at constant
/// speed along its lane. After the end of its recording it goes on straight at its last speed.
/// @param time  [s], >= 0
[[nodiscard]] world::EgoState ego_at(const Scenario& scenario, double time);

}  // namespace saca::sim

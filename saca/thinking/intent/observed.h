#pragma once

#include <cstddef>

#include "saca/base/world/scene.h"
#include "saca/thinking/intent/observation.h"

namespace saca::intent {

/// Beyond this nobody is looked for ahead [m]: as in the recordings that were learnt from.
constexpr double farthest_ahead = 100.0;

/// What a scene shows of one of its actors.
///
/// Lanes are those beside the ego's, all of its width, as far as the road goes; who crosses the
/// road or is off it is on no lane, and what is ahead of it is not known. Who comes along the lanes
/// against their direction sees left and right from its own side. Ahead of an actor can be any
/// other one, and the ego.
/// @param actor  index into scene.actors
[[nodiscard]] Observation observed(const world::Scene& scene, std::size_t actor);

}  // namespace saca::intent

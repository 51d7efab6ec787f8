#pragma once

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"

namespace saca::preview {

/// The actor where a track of it leads at a later time, as surely perceived as it is now: velocity,
/// acceleration and turning are the track's, by central differences over one step. Within the
/// track's first step they are as perceived.
[[nodiscard]] world::Actor moved_along(world::Actor actor, const world::Track& track, double time);

}  // namespace saca::preview

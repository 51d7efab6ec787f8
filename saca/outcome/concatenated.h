#pragma once

#include "saca/manoeuvre/drive.h"
#include "saca/world/track.h"

namespace saca::outcome {

/// `before` until `after` starts, then `after` to its end, in the shorter step of the two. Poses of
/// `before` that stay are the same to the last bit when its step does.
[[nodiscard]] world::Track concatenated(const world::Track& before, const world::Track& after);
[[nodiscard]] manoeuvre::EgoMotion concatenated(const manoeuvre::EgoMotion& before,
                                                const manoeuvre::EgoMotion& after);

}  // namespace saca::outcome

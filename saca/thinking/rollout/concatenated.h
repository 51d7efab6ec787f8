#pragma once

#include "saca/base/world/track.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::rollout {

/// `before` until `after` starts, then `after` to its end, in the shorter step of the two. Poses of
/// `before` that stay are the same to the last bit when its step does.
[[nodiscard]] world::Track concatenated(const world::Track& before, const world::Track& after);
[[nodiscard]] manoeuvre::EgoMotion concatenated(const manoeuvre::EgoMotion& before,
                                                const manoeuvre::EgoMotion& after);

}  // namespace saca::rollout

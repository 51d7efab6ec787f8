#pragma once

#include <span>

#include "saca/onboard/collision/impact.h"

namespace saca::forecast {

/// Expected harm, weighted, of a chain of impacts each of which follows from those before it.
///
/// Each person's chances to come out of every impact unhurt multiply. An impact comes only if all
/// whom the ego has met so far, the one it meets now among them, are really there.
[[nodiscard]] double expected_harm(std::span<const collision::Impact> impacts,
                                   const world::Scene& scene, const collision::HarmModel& harm);

}  // namespace saca::forecast

#pragma once

#include <span>

#include "saca/outcome/blow.h"

namespace saca::outcome {

/// Expected harm, weighted, of a chain of blows each of which follows from those before it.
///
/// Each person's chances to come out of every blow unhurt multiply. A blow comes only if all whom
/// the ego has met so far, the one it meets now among them, are really there.
[[nodiscard]] double toll(std::span<const Blow> blows, const world::Scene& scene,
                          const HarmModel& harm);

}  // namespace saca::outcome

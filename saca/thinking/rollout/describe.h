#pragma once

#include <span>
#include <string>

#include "saca/base/world/scene.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::rollout {

/// Whom or what the ego passes nearest: "car1", "the road's left edge".
/// @param actors  those that the outcome counts in
[[nodiscard]] std::string nearest_name(const collision::Nearest& nearest,
                                       std::span<const world::Actor> actors);

/// An outcome in one line, e.g. "clear by 1.2 m (nearest: car1 at 5.4 s)" or "hits car1 with its
/// front at 4.2 m/s, then truck2 with its rear at 3.0 m/s".
/// @param actors  those that the outcome counts in
[[nodiscard]] std::string describe(const collision::Outcome& outcome,
                                   std::span<const world::Actor> actors);
[[nodiscard]] std::string describe(const collision::Outcome& outcome, const world::Scene& scene);

}  // namespace saca::rollout

#pragma once

#include <span>

#include "saca/base/world/scene.h"

namespace saca::sim {

/// Is a straight line free from one of the ego's eyes to a corner or the centre of an actor? The
/// eyes are in the middle of its front and of its roof. Every body blocks the view, whatever its
/// height: an assumption, for heights are not known. One that covers an eye blinds it to all but
/// itself.
///
/// @param X_WB    the ego, at its centre of mass
/// @param bodies  all who are there; the actor itself, by its name, does not block
/// @throws ContractViolation  if a footprint has no size or a pose is not finite
[[nodiscard]] bool in_sight(const Pose& X_WB, const world::Footprint& ego,
                            const world::Actor& actor, std::span<const world::Actor> bodies);

}  // namespace saca::sim

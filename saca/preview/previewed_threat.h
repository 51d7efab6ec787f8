#pragma once

#include <optional>

#include "saca/intent/motion.h"
#include "saca/intent/observer.h"
#include "saca/preview/threat.h"
#include "saca/world/scene.h"

namespace saca::preview {

/// The nearest conflict under any intention that is likely enough, crossing traffic with the wide
/// tolerance; within thresholds.preview. The ego goes on in its lane, or, where that leads into a
/// conflict within T1, as it is measured to: its driver may stop braking or turning at any time.
/// @param beliefs  one per actor; those that are prepared for are `preview::cautious`
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] std::optional<Threat> previewed_threat(const world::Scene& scene,
                                                     const intent::Beliefs& beliefs,
                                                     const intent::MotionLaw& motion,
                                                     const Thresholds& thresholds);

}  // namespace saca::preview

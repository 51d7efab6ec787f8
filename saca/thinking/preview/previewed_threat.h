#pragma once

#include <optional>

#include "saca/base/world/scene.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/intent/observer.h"

namespace saca::preview {

/// The nearest conflict under any intention that is likely enough, crossing traffic with the wide
/// tolerance; within thresholds.preview. The ego goes on in its lane, or, where that leads into a
/// conflict within T1, as it is measured to: its driver may stop braking or turning at any time.
/// @param beliefs  one per actor; those that are prepared for are `preview::cautious`
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] std::optional<reflex::Threat> previewed_threat(const world::Scene& scene,
                                                             const intent::Beliefs& beliefs,
                                                             const intent::MotionLaw& motion,
                                                             const reflex::Thresholds& thresholds);

}  // namespace saca::preview

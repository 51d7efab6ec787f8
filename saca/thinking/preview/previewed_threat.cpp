#include "saca/thinking/preview/previewed_threat.h"

#include "saca/base/world/time_to_conflict.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/intent/joint.h"
#include "saca/thinking/preview/caution.h"

namespace saca::preview {

std::optional<reflex::Threat> previewed_threat(const world::Scene& scene,
                                               const intent::Beliefs& beliefs,
                                               const intent::MotionLaw& motion,
                                               const reflex::Thresholds& thresholds) {
  const intent::Beliefs prepared = cautious(scene, beliefs, thresholds);
  std::optional<reflex::Threat> nearest =
      reflex::nearest_threat(scene, thresholds.preview, thresholds.preview_tolerance);
  const std::optional<reflex::Threat> trigger = reflex::triggering_threat(scene, thresholds);
  if (trigger && (!nearest || trigger->time < nearest->time)) {
    nearest = trigger;
  }
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    if (world::is_behind(scene, actor)) {
      continue;
    }
    for (const intent::Choice& choice :
         intent::choices_of(prepared[i].now(), thresholds.least_posterior)) {
      const intent::Forecast forecast =
          intent::motion_under(scene, actor, choice.intention, thresholds.preview, motion);
      const auto time = world::time_to_conflict(scene, actor, forecast.track, thresholds.preview,
                                                thresholds.preview_tolerance);
      if (time && (!nearest || *time < nearest->time)) {
        nearest = reflex::Threat{.actor = i, .time = *time};
      }
    }
  }
  return nearest;
}

}  // namespace saca::preview

#include "saca/onboard/reflex/trigger.h"

#include "saca/base/world/time_to_conflict.h"

namespace saca::reflex {

std::optional<Threat> nearest_threat(const world::Scene& scene, double horizon, double tolerance,
                                     world::EgoPrediction ego, const ActorSet& who) {
  std::optional<Threat> nearest;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    if (!who.test(i) || world::is_behind(scene, actor)) {
      continue;
    }
    const auto time =
        world::time_to_conflict(scene, actor, nearest ? nearest->time : horizon, tolerance, ego);
    if (time && (!nearest || *time < nearest->time)) {
      nearest = Threat{.actor = i, .time = *time};
      if (nearest->time <= 0.0) {
        break;  // nothing is nearer than now
      }
    }
  }
  return nearest;
}

std::optional<Threat> measured_threat(const world::Scene& scene, const Thresholds& thresholds,
                                      const ActorSet& who) {
  return nearest_threat(scene, thresholds.preview, thresholds.trigger_tolerance,
                        world::EgoPrediction::as_measured, who);
}

std::optional<Threat> triggering_threat(const world::Scene& scene, const Thresholds& thresholds,
                                        const ActorSet& who) {
  const auto threat = measured_threat(scene, thresholds, who);
  return threat && threat->time <= thresholds.trigger ? threat : std::nullopt;
}

}  // namespace saca::reflex

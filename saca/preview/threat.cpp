#include "saca/preview/threat.h"

#include "saca/core/contract.h"
#include "saca/intent/intention.h"
#include "saca/world/time_to_conflict.h"

namespace saca::preview {

world::Track out_of_the_way(const world::Actor& follower, double time) {
  return {.start = time, .X_WA = {follower.X_WA * Pose{{-out_of_reach, 0.0}, 0.0}}};
}

std::vector<world::Track> without_followers(const world::Scene& scene,
                                            std::span<const world::Track> tracks) {
  expects(tracks.size() == scene.actors.size(), "one track per actor");
  std::vector<world::Track> judged(tracks.begin(), tracks.end());
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (world::is_follower(scene, scene.actors[i])) {
      judged[i] = out_of_the_way(scene.actors[i], scene.time);
    }
  }
  return judged;
}

std::optional<Threat> nearest_threat(const world::Scene& scene, double horizon, double tolerance) {
  std::optional<Threat> nearest;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    if (world::is_behind(scene, actor)) {
      continue;
    }
    const auto time =
        world::time_to_conflict(scene, actor, nearest ? nearest->time : horizon, tolerance);
    if (time && (!nearest || *time < nearest->time)) {
      nearest = Threat{.actor = i, .time = *time};
      if (nearest->time <= 0.0) {
        break;  // nothing is nearer than now
      }
    }
  }
  return nearest;
}

std::optional<Threat> previewed_threat(const world::Scene& scene, const Thresholds& thresholds) {
  std::optional<Threat> nearest =
      nearest_threat(scene, thresholds.preview, thresholds.preview_tolerance);
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    if (world::is_behind(scene, actor)) {
      continue;
    }
    const intent::IntentPosterior posterior = intent::posterior(scene, actor);
    for (const intent::Intention intention : intent::all_intentions) {
      if (posterior[static_cast<std::size_t>(intention)] < thresholds.least_posterior) {
        continue;
      }
      const world::Track track =
          intent::predicted_track(scene, actor, intention, thresholds.preview);
      const auto time = world::time_to_conflict(scene, actor, track, thresholds.preview,
                                                thresholds.preview_tolerance);
      if (time && (!nearest || *time < nearest->time)) {
        nearest = Threat{.actor = i, .time = *time};
      }
    }
  }
  return nearest;
}

}  // namespace saca::preview

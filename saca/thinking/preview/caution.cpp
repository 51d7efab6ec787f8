#include "saca/thinking/preview/caution.h"

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/thinking/intent/intention.h"

namespace saca::preview {
namespace {

using intent::Intention;
using intent::IntentPosterior;

double braking_probability(const IntentPosterior& posterior) {
  double sum = 0.0;
  for (const Intention intention : intent::all_intentions) {
    sum += intent::is_braking(intention) ? posterior[static_cast<std::size_t>(intention)] : 0.0;
  }
  return sum;
}

double least_braking(const world::Scene& scene, const world::Actor& actor,
                     const reflex::Thresholds& thresholds, const Caution& caution) {
  constexpr double rest_speed = 0.1;  // [m/s]
  if (actor.kind == world::ActorKind::obstacle || norm(actor.v_W) < rest_speed) {
    return 0.0;
  }
  if (world::is_crossing(scene, actor)) {
    return caution.crossing;
  }
  const bool in_conflict =
      world::time_to_conflict(scene, actor, thresholds.preview, thresholds.preview_tolerance)
          .has_value();
  return in_conflict ? caution.other : 0.0;
}

}  // namespace

intent::MotionLaw hard_driving() {
  intent::MotionLaw law;
  law.braking = 6.0;
  law.braking_rise = 0.3;
  law.lane_change = 4.0;
  return law;
}

intent::Beliefs cautious(const world::Scene& scene, intent::Beliefs beliefs,
                         const reflex::Thresholds& thresholds, const Caution& caution) {
  expects(beliefs.size() == scene.actors.size(), "one belief per actor");
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const double least = least_braking(scene, scene.actors[i], thresholds, caution);
    const Intention slows =
        intent::is_vru(scene.actors[i].kind) ? Intention::stop : Intention::brake;
    for (IntentPosterior& posterior : beliefs[i].at) {
      const double braking = braking_probability(posterior);
      if (braking >= least) {
        continue;
      }
      const double share = (least - braking) / (1.0 - braking);
      for (double& probability : posterior) {
        probability *= 1.0 - share;
      }
      posterior[static_cast<std::size_t>(slows)] += share;
    }
  }
  return beliefs;
}

}  // namespace saca::preview

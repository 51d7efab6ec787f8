#pragma once

#include <vector>

#include "saca/base/world/scene.h"
#include "saca/thinking/danger/risk.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/preview/plan_facts.h"

namespace saca::preview {

/// A likely situation at the trigger: the forecast scene, with all that is computed about it.
struct Situation {
  world::Scene scene_at_trigger;
  double probability = 0.0;                         ///< of this hypothesis about intentions
  std::vector<intent::Intention> intentions;        ///< one per actor: the hypothesis itself
  std::vector<intent::IntentPosterior> posteriors;  ///< one per actor, when the preview was made,
                                                    ///< as `preview::cautious` has them
  std::vector<danger::ObstacleRisk> risks;          ///< one per actor, at the trigger
  std::vector<world::Track> tracks;                 ///< one per actor, from the preview on
  std::vector<world::SpreadOverTime> spreads;       ///< about the tracks, from the trigger on; of
                                                    ///< who reacts to the ego, as perceived
  AllFacts facts;
  PolicyDangers dangers;  ///< where V_h is known at all
};

}  // namespace saca::preview

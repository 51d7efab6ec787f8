#pragma once

#include <vector>

#include "saca/intent/intention.h"
#include "saca/preview/plan_facts.h"
#include "saca/reach/risk.h"
#include "saca/world/scene.h"

namespace saca::preview {

/// A likely situation at the trigger: the forecast scene, with all that is computed about it.
struct Situation {
  world::Scene scene_at_trigger;
  double probability = 0.0;                         ///< of this hypothesis about intentions
  std::vector<intent::Intention> intentions;        ///< one per actor: the hypothesis itself
  std::vector<intent::IntentPosterior> posteriors;  ///< one per actor, when the preview was made,
                                                    ///< as `preview::cautious` has them
  std::vector<reach::ObstacleRisk> risks;           ///< one per actor, at the trigger
  std::vector<world::Track> tracks;                 ///< one per actor, from the preview on
  std::vector<world::SpreadOverTime> spreads;       ///< about the tracks, from the trigger on; of
                                                    ///< who reacts to the ego, as perceived
  AllFacts facts;
  PolicyDangers dangers;  ///< where V_h is known at all
};

}  // namespace saca::preview

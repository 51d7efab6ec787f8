#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "saca/intent/intention.h"
#include "saca/manoeuvre/plan.h"
#include "saca/outcome/outcome.h"
#include "saca/reach/risk.h"
#include "saca/world/scene.h"

namespace saca::preview {

/// What one policy is forecast to end in; why it cannot be driven, where it cannot.
struct PolicyFacts {
  manoeuvre::Plan plan;
  std::string refusal;       ///< empty when the plan can be driven
  outcome::Outcome outcome;  ///< meaningless when refused
  double probability = 0.0;  ///< of contact with anybody, or an edge that stops the ego;
                             ///< rolled out: 1 with any contact
  bool rolled_out = false;  ///< with full dynamics; else read from the atlas, where outcome.harm is
                            ///< the expected one, and contact that at the mean
};

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
  std::array<PolicyFacts, manoeuvre::num_policies> facts;
};

}  // namespace saca::preview

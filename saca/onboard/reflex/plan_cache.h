#pragma once

#include <cstdint>
#include <string_view>

#include "saca/base/core/static_vector.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/match/similarity.h"

namespace saca::reflex {

/// Where an executed plan came from.
enum class Source : std::uint8_t {
  fallback,  ///< nothing could be judged: emergency braking
  memory,    ///< the policy of a stored case
  model,     ///< chosen by the language model, checked by rollout
  forced,    ///< the user asked for it
  arbiter,   ///< what the verdict speaks for (plan_of)
};
[[nodiscard]] std::string_view name(Source source);

/// Whether what was cached is held against the verdict before it is carried out.
enum class Guard : std::uint8_t {
  never_worse_than_braking,  ///< what is not admissible is not carried out, and what is carried out
                             ///< is supervised: nothing is known to be worse than braking
  none,                      ///< Algorithm 1 of the paper: a plan that memory holds
                             ///< (above 90 %) or the model chose is cached unchecked, and carried
                             ///< out where its situation matches
};

/// A checked plan, ready for the situation that it was made for.
struct CachedPlan {
  match::Features at_trigger;  ///< of the scene that was forecast
  double trigger = 0.0;        ///< when, in the scene's time [s]
  manoeuvre::Plan plan;
  Source source = Source::model;
  bool worse_than_aeb = false;  ///< by forecast, by the one ordering of harm
  std::int32_t preview = 0;     ///< number of the preview in the record
};

/// What the thinking plane hands over: all plans that are ready now.
using PlanCache = StaticVector<CachedPlan, 6>;

}  // namespace saca::reflex

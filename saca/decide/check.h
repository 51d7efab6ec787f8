#pragma once

#include <string>

#include "saca/manoeuvre/plan.h"
#include "saca/preview/policy_facts.h"
#include "saca/preview/situation.h"

namespace saca::decide {

/// What the rollout check says of a plan.
struct Check {
  bool passed = false;
  std::string text;  ///< why, in one line
};

/// The rollout check: the plan and emergency braking are driven with full dynamics, whatever was
/// forecast before. A plan passes that can be driven here, where braking does not end better by the
/// one ordering of outcome/ordering.h: less harm, or the same by milder means.
[[nodiscard]] Check check(const manoeuvre::Plan& plan, const preview::Situation& situation,
                          const preview::ForecastTools& tools);

/// The stricter check of a choice that rests on something false (reason::Truth): only what is best
/// of all that was forecast passes. Rolls nothing out; beside `check`, not in its place.
[[nodiscard]] Check check_unfounded(manoeuvre::PolicyId chosen,
                                    const preview::Situation& situation);

/// The same as `check` of what the two end in.
[[nodiscard]] Check check(const preview::PolicyFacts& plan, const preview::PolicyFacts& aeb,
                          const world::Scene& scene);

}  // namespace saca::decide

#pragma once

#include <string>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/forecast_facts.h"
#include "saca/thinking/preview/situation.h"

namespace saca::arbitration {

/// What the rollout check says of a plan.
struct Check {
  bool passed = false;
  std::string text;  ///< why, in one line
};

/// The rollout check: the plan and emergency braking are driven with full dynamics and held against
/// the same draws of where the others may be (preview::drawn_motions of the situation), with
/// everything that follows a contact; whatever was forecast before. As with the facts and the
/// verdict, expected harm decides: whether one future is missed by a centimetre does not. Braking
/// itself always passes: how hard is decided at the trigger.
[[nodiscard]] Check check(const manoeuvre::Plan& plan, const preview::Situation& situation,
                          const preview::ForecastTools& tools);

/// The same of what the two are expected to end in. A plan passes that can be driven, where braking
/// is not better by the one ordering of collision/ordering.h: less harm, or the same by milder
/// means.
[[nodiscard]] Check check(const preview::ExpectedHarm& plan, const preview::ExpectedHarm& aeb);

/// The stricter check of a choice that rests on something false (language_model::Truth): only what
/// is best of all that was forecast passes. Rolls nothing out; beside `check`, not in its place.
[[nodiscard]] Check check_unfounded(manoeuvre::PolicyId chosen,
                                    const preview::Situation& situation);

}  // namespace saca::arbitration

#pragma once

#include <optional>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/preview/situation.h"

namespace saca::arbitration {

using preview::AllFacts;

/// How much more harm a policy is forecast to do than the least of all [harm]; infinite where it
/// cannot be driven.
[[nodiscard]] double regret(const AllFacts& facts, manoeuvre::PolicyId policy);

/// Have the facts of a forecast changed so much that whoever chose by them has to choose anew? A
/// policy that was as good as the best (a regret of 0.002 at most, which forecasts cannot tell from
/// none) is materially worse now (`material_harm`), or the other way round. In between nothing has
/// changed, so that facts that waver are not a change each time. Facts read from the atlas and
/// facts of full dynamics are not compared.
/// @return  the first such policy
[[nodiscard]] std::optional<manoeuvre::PolicyId> changed_policy(const AllFacts& before,
                                                                const AllFacts& now);

}  // namespace saca::arbitration

#pragma once

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// What somebody would choose who knows how it ends on average, but takes nothing that is
/// knowingly worse than the best: doing nothing, where that is admissible (it is looked at again
/// every moment, and no prompt tells whether it will stay so); else of the admissible policies that
/// of the least known harm; of those within memory::as_good of it the mildest (collision::milder);
/// of equally mild ones the better by forecast.
///
/// @param known  harm by PolicyId [-], a mean over draws; where it is not known of some admissible
///               policy, the forecast decides in its place, for all
/// @throws ContractViolation  if nothing can be driven
[[nodiscard]] manoeuvre::PolicyId expert_choice(const preview::AllFacts& facts,
                                                const memory::PolicyHarms& known);

}  // namespace saca::language_model

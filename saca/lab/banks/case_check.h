#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "saca/thinking/intent/model.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::banks {

/// Works out anew what every policy is expected to harm in a case, with the car at hand: its body
/// takes the place of the one in the case.
///
/// Where a policy that it speaks for is as good as the best, it is trusted by this car; where each
/// is expected to do materially more harm than full braking (reflex::material_harm), quarantined:
/// then it says what was worked out, and what happened to another car, or by other harm, is left
/// out. Else it stays as it is, so that checking it once more finds the same.
///
/// @param one    its scene breaks no rule of `world::broken_rule`
/// @param intent  tells the intentions of actors of which the case does not
/// @param draws  that the expectation is the mean of, >= 1
/// @param made_with  encounter::made_with of these: the same for all cases
/// @return       what is known of the case from now on, its scene is as it was; nullopt: no more
///               than before
[[nodiscard]] std::optional<memory::Case> checked(const memory::Case& one,
                                                  const preview::ForecastTools& tools,
                                                  const intent::Model& intent, std::size_t draws,
                                                  const std::vector<memory::MadeWith>& made_with);

}  // namespace saca::banks

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "saca/intent/model.h"
#include "saca/memory/case.h"
#include "saca/preview/policy_facts.h"

namespace saca::eval {

/// What rollouts say of a case that is not trusted.
enum class CaseCheck : std::uint8_t {
  confirmed,  ///< a policy that it speaks for is as good as the best: it is trusted from now on
  open,       ///< none is, and none is refuted: it stays unchecked
  refuted,    ///< each is expected to do materially more harm than full braking
              ///< (decide::material_harm): quarantined
};
[[nodiscard]] std::string_view name(CaseCheck check);

struct CheckedCase {
  CaseCheck check = CaseCheck::open;
  memory::Case one;  ///< what is known of the case from now on; its scene is as it was
};

/// Works out anew what every policy is expected to harm in a case, with the car at hand: its body
/// takes the place of the one in the case. What happened to another car, or by other harm, says
/// nothing of this one and is left out.
///
/// @param one    its scene breaks no rule of `world::broken_rule`
/// @param intent  tells the intentions of actors of which the case does not
/// @param draws  that the expectation is the mean of, >= 1
/// @param made_with  loop::made_with of these: the same for all cases
[[nodiscard]] CheckedCase checked(const memory::Case& one, const preview::ForecastTools& tools,
                                  const intent::Model& intent, std::size_t draws,
                                  const std::vector<memory::MadeWith>& made_with);

}  // namespace saca::eval

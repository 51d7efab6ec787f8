#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "saca/memory/case.h"

namespace saca::memory {

/// Those that are missed least if no more than `most` are to be kept, the most redundant first:
/// one after the other, the trusted case that differs least from a trusted one that stays and
/// speaks for the same policies (as_good_as_best). Of two such the newer goes. What was driven by
/// the car itself, what experts contributed and what is not trusted stays in any case.
///
/// @param cases  by ascending id; no scene breaks a rule of `world::broken_rule`
/// @return       fewer than would be needed where the rest is alike to nothing or must stay
[[nodiscard]] std::vector<CaseId> most_redundant(std::span<const Case> cases, std::size_t most);

}  // namespace saca::memory

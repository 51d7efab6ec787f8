#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/onboard/match/feature_index.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"

namespace saca::memory {

/// Those that are missed least if no more than `most` are to be kept, the most redundant first:
/// one after the other, the trusted case that differs least from a trusted one that stays and
/// speaks for the same policies (as_good_as_best), worked out with the same car and harm. Of two
/// such the newer goes. What was driven by the car itself, what experts contributed and what is not
/// trusted stays in any case.
///
/// @param cases  by ascending id; no scene breaks a rule of `world::broken_rule`
/// @return       fewer than would be needed where the rest is alike to nothing or must stay
[[nodiscard]] std::vector<match::CaseId> most_redundant(std::span<const Case> cases,
                                                        std::size_t most);

/// Those of these cases that have one of these ids.
[[nodiscard]] std::vector<Case> cases_of(std::span<const match::CaseId> ids,
                                         std::span<const Case> cases);

/// How many cases a bank is kept to by itself: as many as are searched exactly.
constexpr std::size_t usual_bound = match::FeatureIndex::usually_exact;

/// Where a bank holds more than `most`, forgets the most redundant until a twentieth of `most` is
/// free, so that it need not be done for each new case. Where what may not go leaves it beyond
/// `most`, it is tried again when a twentieth more has come. What somebody learns of meanwhile
/// stays (Store::forget).
/// @param newest  stays, whatever is like it
/// @return        how many were forgotten; or what `Store::all` or `Store::forget` could not do
[[nodiscard]] Result<std::size_t> keep_within(Store& memory, std::size_t most,
                                              match::CaseId newest);

}  // namespace saca::memory

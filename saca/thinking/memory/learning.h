#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "saca/thinking/memory/case.h"

namespace saca::memory {

/// Scenes that differ by less (match::difference) are the same encounter met again.
constexpr double same_encounter = 0.25;

/// Do they speak for policies, and for none in common?
[[nodiscard]] bool contradict(const Case& a, const Case& b) noexcept;

/// Two cases of one encounter as one. Counts add up; harms are means of as many encounters as each
/// stands for, and the largest is kept beside them; the best in hindsight is that of the least mean
/// harm, as long as each policy's is known. Of hearsay there are no figures: those of the other
/// stay as they are, and where nothing was told there, what a check told of the hearsay is kept.
/// All else is the older's: its id, its scene, how far it is trusted; but lessons are those of
/// both, and what the car drove itself in one of them is its own.
[[nodiscard]] Case merged(const Case& older, const Case& newer);

/// Adds what was learnt; of more than `most_texts` the newest are kept.
void add_lessons(Case& one, std::span<const std::string> lessons);

/// What learning a case came to.
struct LearningResult {
  enum class How : std::uint8_t {
    added,         ///< nothing stored was the same encounter
    merged,        ///< into the case `id`, which was
    contradicted,  ///< added, and the case `other`, which was the same encounter, speaks for
                   ///< others: neither is used unchecked from now on
  };
  How how = How::added;
  match::CaseId id = 0;
  match::CaseId other = 0;
};

}  // namespace saca::memory

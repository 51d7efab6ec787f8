#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intent {

/// Something that a road user may intend.
struct Choice {
  Intention intention = Intention::maintain;
  double probability = 1.0;  ///< in [0, 1]
};
using Choices = StaticVector<Choice, num_intentions>;

/// The intentions that have at least this probability, in the order of the enumeration.
[[nodiscard]] Choices choices_of(const IntentPosterior& posterior, double least);

/// What all road users intend together.
struct Hypothesis {
  double probability = 1.0;           ///< of all of it: they are taken as independent
  std::vector<Intention> intentions;  ///< one per road user
};

/// The likeliest hypotheses, in falling order; among equals those first in which earlier road users
/// differ from their likeliest choice. Exact.
///
/// @param choices  of each road user, at least one; of equal ones the first counts as likelier
/// @param most     how many are wanted
/// @return         fewer where there are not so many; of nobody, one that says nothing
/// @throws ContractViolation  if somebody has no choice, or a probability is outside [0, 1]
///
/// O(n m (log(n m) + n)) for n road users and m hypotheses.
[[nodiscard]] std::vector<Hypothesis> likeliest_hypotheses(std::span<const Choices> choices,
                                                           std::size_t most);

}  // namespace saca::intent

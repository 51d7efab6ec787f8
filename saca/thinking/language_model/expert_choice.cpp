#include "saca/thinking/language_model/expert_choice.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::language_model {

using manoeuvre::PolicyId;

PolicyId expert_choice(const preview::AllFacts& facts, const memory::PolicyHarms& known) {
  const memory::Policies may = admissible(facts);
  expects(may.any(), "something can be driven");
  if (may.test(manoeuvre::index(PolicyId::no_intervention))) {
    return PolicyId::no_intervention;
  }
  bool is_known = true;
  for (std::size_t k = 0; k < may.size(); ++k) {
    is_known = is_known && (!may.test(k) || known.at(k).has_value());
  }
  const auto harm_of = [&](PolicyId policy) {
    return is_known ? *known.at(manoeuvre::index(policy))
                    : facts[manoeuvre::index(policy)].outcome().harm;
  };
  double least = std::numeric_limits<double>::infinity();
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (may.test(manoeuvre::index(policy))) {
      least = std::min(least, harm_of(policy));
    }
  }
  std::optional<PolicyId> best;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (!may.test(manoeuvre::index(policy)) || harm_of(policy) > least + memory::as_good) {
      continue;
    }
    const bool equally_mild =
        best && !collision::milder(*best, policy) && !collision::milder(policy, *best);
    if (!best || collision::milder(policy, *best) ||
        (equally_mild &&
         preview::better(facts[manoeuvre::index(policy)], facts[manoeuvre::index(*best)]))) {
      best = policy;
    }
  }
  return *best;
}

}  // namespace saca::language_model

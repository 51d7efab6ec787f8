#include "saca/thinking/arbitration/facts_change.h"

#include <algorithm>
#include <limits>

#include "saca/onboard/reflex/verdict.h"

namespace saca::arbitration {
namespace {

constexpr double as_good = 0.002;  // [harm], as for what is admissible (admissible_harm)
constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

double regret(const AllFacts& facts, manoeuvre::PolicyId policy) {
  const preview::PolicyFacts& fact = facts[manoeuvre::index(policy)];
  return fact.drivable() ? fact.outcome().harm - preview::least_harm(facts) : never;
}

std::optional<manoeuvre::PolicyId> changed_policy(const AllFacts& before, const AllFacts& now) {
  if (preview::rolled_out(before) != preview::rolled_out(now)) {
    return std::nullopt;
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const double then = regret(before, policy);
    const double is = regret(now, policy);
    if (std::min(then, is) <= as_good && std::max(then, is) >= reflex::material_harm) {
      return policy;
    }
  }
  return std::nullopt;
}

}  // namespace saca::arbitration

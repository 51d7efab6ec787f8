#include "saca/decide/facts_change.h"

#include <algorithm>
#include <limits>

#include "saca/decide/verdict.h"

namespace saca::decide {
namespace {

constexpr double as_good = 0.002;  // [harm], as for what is admissible (admissible_harm)
constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

double regret(const AllFacts& facts, manoeuvre::PolicyId policy) {
  double least = never;
  for (const preview::PolicyFacts& fact : facts) {
    least = fact.refusal.empty() ? std::min(least, fact.outcome.harm) : least;
  }
  const preview::PolicyFacts& fact = facts[manoeuvre::index(policy)];
  return fact.refusal.empty() ? fact.outcome.harm - least : never;
}

std::optional<manoeuvre::PolicyId> changed_policy(const AllFacts& before, const AllFacts& now) {
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const std::size_t i = manoeuvre::index(policy);
    if (before[i].rolled_out != now[i].rolled_out) {
      return std::nullopt;
    }
    const double then = regret(before, policy);
    const double is = regret(now, policy);
    if (std::min(then, is) <= as_good && std::max(then, is) >= material_harm) {
      return policy;
    }
  }
  return std::nullopt;
}

}  // namespace saca::decide

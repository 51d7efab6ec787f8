#include "saca/thinking/preview/plan_facts.h"

#include <algorithm>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/ordering.h"

namespace saca::preview {
namespace {

using manoeuvre::PolicyId;

/// The least harm of one kind; infinite where there is none of it.
template <class Kind>
double least_of(const AllFacts& facts) {
  double least = std::numeric_limits<double>::infinity();
  for (const PolicyFacts& fact : facts) {
    if (const auto* one = std::get_if<Kind>(&fact.end)) {
      least = std::min(least, one->outcome.harm);
    }
  }
  return least;
}

template <class Kind>
bool has(const AllFacts& facts) {
  return std::any_of(facts.begin(), facts.end(), [](const PolicyFacts& fact) {
    return std::holds_alternative<Kind>(fact.end);
  });
}

}  // namespace

bool better(const ExpectedOutcome& a, PolicyId policy_a, const ExpectedOutcome& b,
            PolicyId policy_b) {
  return collision::better(a.outcome, policy_a, b.outcome, policy_b);
}

bool better(const RolledOutcome& a, PolicyId policy_a, const RolledOutcome& b, PolicyId policy_b) {
  return collision::better(a.outcome, policy_a, b.outcome, policy_b);
}

const std::string& PolicyFacts::refusal() const {
  const auto* const refused = std::get_if<Refusal>(&end);
  expects(refused != nullptr, "the plan cannot be driven");
  return refused->why;
}

const collision::Outcome& PolicyFacts::outcome() const {
  expects(drivable(), "the plan can be driven");
  const auto* const expected = std::get_if<ExpectedOutcome>(&end);
  return expected != nullptr ? expected->outcome : std::get<RolledOutcome>(end).outcome;
}

collision::Outcome& PolicyFacts::outcome() {
  expects(drivable(), "the plan can be driven");
  auto* const expected = std::get_if<ExpectedOutcome>(&end);
  return expected != nullptr ? expected->outcome : std::get<RolledOutcome>(end).outcome;
}

double PolicyFacts::contact_probability() const {
  if (const auto* const expected = std::get_if<ExpectedOutcome>(&end)) {
    return expected->contact_probability;
  }
  return outcome().contact ? 1.0 : 0.0;
}

bool better(const PolicyFacts& a, const PolicyFacts& b) {
  if (!a.drivable() || !b.drivable()) {
    return a.drivable();
  }
  expects(a.end.index() == b.end.index(), "both are expected, or both are rolled out");
  if (const auto* const expected = std::get_if<ExpectedOutcome>(&a.end)) {
    return better(*expected, a.plan.policy, std::get<ExpectedOutcome>(b.end), b.plan.policy);
  }
  return better(std::get<RolledOutcome>(a.end), a.plan.policy, std::get<RolledOutcome>(b.end),
                b.plan.policy);
}

bool rolled_out(const AllFacts& facts) {
  return has<RolledOutcome>(facts);
}

double least_harm(const AllFacts& facts) {
  expects(!has<ExpectedOutcome>(facts) || !has<RolledOutcome>(facts),
          "all are expected, or all are rolled out");
  return rolled_out(facts) ? least_of<RolledOutcome>(facts) : least_of<ExpectedOutcome>(facts);
}

}  // namespace saca::preview

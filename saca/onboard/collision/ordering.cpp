#include "saca/onboard/collision/ordering.h"

#include <cmath>
#include <tuple>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/outcome.h"

namespace saca::collision {

using manoeuvre::PolicyId;

double harm_class(double harm) {
  expects(harm >= 0.0 && std::isfinite(harm), "harm >= 0");
  return std::round(harm / harm_tie);
}

int severity(PolicyId policy) {
  switch (policy) {
    case PolicyId::no_intervention:
      return 0;
    case PolicyId::aeb:
      return 1;
    case PolicyId::es_b_left:
    case PolicyId::es_b_right:
      return 2;
    case PolicyId::aes_left:
    case PolicyId::aes_right:
      return 3;
    case PolicyId::t_drift_left:
    case PolicyId::t_drift_right:
      break;
  }
  return 4;
}

bool milder(PolicyId a, PolicyId b) {
  return severity(a) < severity(b);
}

bool better(const Outcome& a, PolicyId policy_a, const Outcome& b, PolicyId policy_b) {
  const auto key = [](const Outcome& outcome, PolicyId policy) {
    expects(outcome.clearance >= 0.0 && std::isfinite(outcome.clearance), "clearance >= 0");
    return std::tuple{harm_class(outcome.harm), severity(policy),
                      -std::round(outcome.clearance / 1e-3)};
  };
  return key(a, policy_a) < key(b, policy_b);
}

}  // namespace saca::collision

#include "saca/decide/corrected_verdict.h"

#include <algorithm>

namespace saca::decide {

void correct(Verdict& verdict, const memory::Corrections& corrections) noexcept {
  const auto correct_one = [&corrections](JudgedPlan& one) {
    one.harm = std::max(0.0, one.harm + corrections[manoeuvre::index(one.plan.policy)]);
  };
  const JudgedPlan* const best_before = least_harmful(verdict);
  const double before = best_before == nullptr ? 0.0 : best_before->harm;
  std::for_each(verdict.plans.begin(), verdict.plans.end(), correct_one);
  if (verdict.under_way) {
    correct_one(*verdict.under_way);
  }
  const JudgedPlan* const best = least_harmful(verdict);
  if (verdict.later && best != nullptr) {
    *verdict.later += best->harm - before;
  }
}

}  // namespace saca::decide

#include "saca/decide/verdict.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "saca/outcome/ordering.h"

namespace saca::decide {
namespace {

using manoeuvre::doing_nothing;
using manoeuvre::full_braking;
using manoeuvre::Plan;
using manoeuvre::PolicyId;

constexpr double least_tolerance = 0.002;  // of harm
constexpr double tolerance_share = 0.03;   // of what braking has above the best

bool harms_nobody(const JudgedPlan* plan) {
  return plan != nullptr && plan->drivable && plan->contact == 0.0 && plan->harm == 0.0;
}

bool is_admissible(const JudgedPlan& plan, std::optional<double> admissible) {
  return admissible && plan.drivable && plan.harm <= *admissible;
}

}  // namespace

const JudgedPlan* least_harmful(const Verdict& verdict) noexcept {
  const JudgedPlan* least = nullptr;
  for (const JudgedPlan& one : verdict.plans) {
    if (one.drivable && (least == nullptr || one.harm < least->harm)) {
      least = &one;
    }
  }
  return least;
}

std::optional<double> admissible_harm(const Verdict& verdict) noexcept {
  const JudgedPlan* const least = least_harmful(verdict);
  if (least == nullptr) {
    return std::nullopt;
  }
  const JudgedPlan* const aeb = find_plan(verdict, full_braking);
  const double above = aeb == nullptr || !aeb->drivable ? 0.0 : aeb->harm - least->harm;
  return least->harm + std::max(least_tolerance, tolerance_share * above);
}

std::size_t num_admissible(const Verdict& verdict) noexcept {
  const auto most = admissible_harm(verdict);
  return static_cast<std::size_t>(
      std::count_if(verdict.plans.begin(), verdict.plans.end(),
                    [&](const JudgedPlan& one) { return is_admissible(one, most); }));
}

const JudgedPlan* find_plan(const Verdict& verdict, const Plan& plan) noexcept {
  const JudgedPlan* nearest = nullptr;
  const auto off = [&](const JudgedPlan& one) {
    return std::abs(one.plan.target_speed.value_or(0.0) - plan.target_speed.value_or(0.0));
  };
  for (const JudgedPlan& one : verdict.plans) {
    if (one.plan.policy == plan.policy && (nearest == nullptr || off(one) < off(*nearest))) {
      nearest = &one;
    }
  }
  return nearest;
}

Plan plan_of(const Verdict& verdict) noexcept {
  if (harms_nobody(find_plan(verdict, doing_nothing))) {
    return doing_nothing;
  }
  if (admits(verdict, full_braking)) {
    return full_braking;
  }
  const auto most = admissible_harm(verdict);
  const auto key = [](const JudgedPlan& one) {
    return std::tuple{outcome::severity(one.plan.policy), one.harm};
  };
  const JudgedPlan* mildest = nullptr;
  for (const JudgedPlan& one : verdict.plans) {
    if (is_admissible(one, most) && one.plan.policy != PolicyId::no_intervention &&
        (mildest == nullptr || key(one) < key(*mildest))) {
      mildest = &one;
    }
  }
  return mildest == nullptr ? full_braking : mildest->plan;
}

bool admits(const Verdict& verdict, const Plan& plan) noexcept {
  const JudgedPlan* const judged = find_plan(verdict, plan);
  return judged != nullptr && is_admissible(*judged, admissible_harm(verdict));
}

}  // namespace saca::decide

#include "saca/onboard/reflex/verdict.h"

#include <algorithm>
#include <tuple>

#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/forecast/admissible.h"

namespace saca::reflex {
namespace {

using manoeuvre::doing_nothing;
using manoeuvre::full_braking;
using manoeuvre::Plan;
using manoeuvre::PolicyId;

/// The judged braking that is next to this strength, on the harder side or the gentler one.
const JudgedPlan* next_to(const Verdict& verdict, const Plan& plan, bool harder) {
  const JudgedPlan* next = nullptr;
  const auto off = [&](const JudgedPlan& one) {
    return (harder ? 1.0 : -1.0) * (strength_of(one.plan) - strength_of(plan));
  };
  for (const JudgedPlan& one : verdict.plans) {
    if (one.drivable && one.plan.policy == PolicyId::aeb && off(one) > 0.0 &&
        (next == nullptr || off(one) < off(*next))) {
      next = &one;
    }
  }
  return next;
}

bool is_admissible(const JudgedPlan& plan, std::optional<double> admissible) {
  return admissible && plan.drivable && plan.harm <= *admissible;
}

}  // namespace

void spread_over_strengths(Verdict& verdict) noexcept {
  constexpr double weight = 0.25;  // of each neighbour
  const Verdict told = verdict;
  for (std::size_t i = 0; i < verdict.plans.size(); ++i) {
    JudgedPlan& one = verdict.plans[i];
    if (!one.drivable || one.plan.policy != PolicyId::aeb || !(strength_of(one.plan) < 1.0)) {
      continue;
    }
    for (const bool harder : {true, false}) {
      if (const JudgedPlan* const next = next_to(told, one.plan, harder)) {
        one.harm += weight * (next->harm - told.plans[i].harm);
        one.contact += weight * (next->contact - told.plans[i].contact);
      }
    }
  }
}

const JudgedPlan* least_harmful(const Verdict& verdict) noexcept {
  const JudgedPlan* least = nullptr;
  for (const JudgedPlan& one : verdict.plans) {
    if (one.drivable && (least == nullptr || one.harm < least->harm)) {
      least = &one;
    }
  }
  return least;
}

std::optional<double> cost_of_waiting(const Verdict& verdict) noexcept {
  const JudgedPlan* const least = least_harmful(verdict);
  return verdict.later && least != nullptr ? std::optional(*verdict.later - least->harm)
                                           : std::nullopt;
}

std::optional<double> admissible_harm(const Verdict& verdict) noexcept {
  const JudgedPlan* const least = least_harmful(verdict);
  if (least == nullptr) {
    return std::nullopt;
  }
  const JudgedPlan* const aeb = find_plan(verdict, full_braking);
  return forecast::admissible_harm(least->harm,
                                   aeb == nullptr || !aeb->drivable ? least->harm : aeb->harm);
}

std::size_t num_admissible(const Verdict& verdict) noexcept {
  const auto most = admissible_harm(verdict);
  return static_cast<std::size_t>(
      std::count_if(verdict.plans.begin(), verdict.plans.end(),
                    [&](const JudgedPlan& one) { return is_admissible(one, most); }));
}

const JudgedPlan* find_plan(const Verdict& verdict, const Plan& plan) noexcept {
  return manoeuvre::most_like<JudgedPlan>({verdict.plans.begin(), verdict.plans.size()}, plan);
}

const JudgedPlan* best_braking(const Verdict& verdict) noexcept {
  const auto brakes = [](const JudgedPlan& one) {
    return one.drivable && one.plan.policy == PolicyId::aeb;
  };
  const JudgedPlan* least = nullptr;
  for (const JudgedPlan& one : verdict.plans) {
    if (brakes(one) && (least == nullptr || one.harm < least->harm)) {
      least = &one;
    }
  }
  if (least == nullptr) {
    return nullptr;
  }
  const double most = std::min(least->harm + forecast::least_tolerance,
                               std::max(least->harm, admissible_harm(verdict).value_or(0.0)));
  const JudgedPlan* best = least;
  for (const JudgedPlan& one : verdict.plans) {
    if (brakes(one) && one.harm <= most && strength_of(one.plan) > strength_of(best->plan)) {
      best = &one;
    }
  }
  return best;
}

Plan plan_of(const Verdict& verdict) noexcept {
  if (admits(verdict, doing_nothing)) {
    return doing_nothing;
  }
  const auto most = admissible_harm(verdict);
  const JudgedPlan* const best = best_braking(verdict);
  const JudgedPlan* const braking = best != nullptr && is_admissible(*best, most) ? best : nullptr;
  if (braking != nullptr && admits(verdict, full_braking)) {
    return braking->plan;
  }
  const auto key = [](const JudgedPlan& one) {
    return std::tuple{collision::severity(one.plan.policy), one.harm};
  };
  const JudgedPlan* mildest = nullptr;  // of those that leave the lane
  for (const JudgedPlan& one : verdict.plans) {
    if (is_admissible(one, most) && collision::milder(PolicyId::aeb, one.plan.policy) &&
        (mildest == nullptr || key(one) < key(*mildest))) {
      mildest = &one;
    }
  }
  if (braking != nullptr &&
      (mildest == nullptr || braking->harm <= mildest->harm + collision::harm_tie)) {
    return braking->plan;
  }
  return mildest == nullptr ? full_braking : mildest->plan;
}

Plan as_judged(const Verdict& verdict, const Plan& plan) noexcept {
  const JudgedPlan* const braking =
      manoeuvre::takes_strength(plan.policy) ? best_braking(verdict) : nullptr;
  return braking == nullptr ? plan : braking->plan;
}

bool admits(const Verdict& verdict, const Plan& plan) noexcept {
  const JudgedPlan* const judged = find_plan(verdict, plan);
  return judged != nullptr && is_admissible(*judged, admissible_harm(verdict));
}

}  // namespace saca::reflex

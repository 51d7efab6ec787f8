#pragma once

// Verdicts of round numbers, for the tests of this module.

#include <initializer_list>
#include <utility>

#include "saca/decide/verdict.h"

namespace saca::decide {

/// A verdict at `time` that has these plans with these expected harms; contact where there is harm.
inline Verdict verdict_of(double time,
                          std::initializer_list<std::pair<manoeuvre::PolicyId, double>> harms) {
  Verdict verdict{.time = time};
  for (const auto& [policy, harm] : harms) {
    const manoeuvre::Plan plan{
        policy, manoeuvre::brakes_to_speed(policy) ? std::optional(10.0) : std::nullopt};
    verdict.plans.push_back(
        {.plan = plan, .drivable = true, .harm = harm, .contact = harm > 0.0 ? 0.5 : 0.0});
  }
  return verdict;
}

}  // namespace saca::decide

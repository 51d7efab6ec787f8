#include "saca/onboard/forecast/plans.h"

#include <optional>

namespace saca::forecast {

using manoeuvre::PolicyId;

std::span<const double> strengths_of(Braking braking) {
  return braking == Braking::full ? std::span<const double>() : manoeuvre::braking_strengths;
}

Plans all_plans(double speed, Braking braking) {
  Plans plans;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (!manoeuvre::brakes_to_speed(policy)) {
      plans.push_back({policy, std::nullopt});
      if (manoeuvre::takes_strength(policy)) {
        for (const double strength : strengths_of(braking)) {
          plans.push_back({policy, std::nullopt, strength});
        }
      }
      continue;
    }
    for (const double share : target_shares) {
      plans.push_back({policy, share * speed});
    }
  }
  return plans;
}

}  // namespace saca::forecast

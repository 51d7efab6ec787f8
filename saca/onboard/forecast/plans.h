#pragma once

#include <cstdint>
#include <span>

#include "saca/base/core/static_vector.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::forecast {

/// How policy 0 may brake.
enum class Braking : std::uint8_t {
  any_strength,  ///< with all the grip, or one of manoeuvre::braking_strengths of it
  full,          ///< with all of it, as the paper has it
};

/// The strengths of policy 0 besides the full one, hardest first.
[[nodiscard]] std::span<const double> strengths_of(Braking braking);

/// Every plan that can be chosen at `speed` [m/s]: each policy, 3 and 4 once for each of
/// target_shares of it, and 0 once more for each of manoeuvre::braking_strengths; of each
/// the default (manoeuvre::default_plan) first. Allocates nothing.
using Plans = StaticVector<manoeuvre::Plan, manoeuvre::num_policies + 2 * target_shares.size() +
                                                manoeuvre::braking_strengths.size()>;
[[nodiscard]] Plans all_plans(double speed, Braking braking = Braking::any_strength);

}  // namespace saca::forecast

#pragma once

#include <optional>

#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::runs {

/// What is asked to be carried out at the trigger, whatever was thought.
struct ForcedPolicy {
  std::optional<manoeuvre::PolicyId> policy;  ///< nullopt: what SACA decides
  std::optional<double> target_speed;         ///< [m/s]; of policies that brake to one
  std::optional<double> strength;             ///< [-]; of policies that take one
};

/// @return  nullopt: what SACA decides is carried out; out_of_range, naming the option, where speed
///          or strength are none of the policy's
[[nodiscard]] Result<std::optional<manoeuvre::Plan>> forced_plan(const ForcedPolicy& forced);

}  // namespace saca::runs

#include "saca/lab/runs/forced_plan.h"

namespace saca::runs {

Result<std::optional<manoeuvre::Plan>> forced_plan(const ForcedPolicy& forced) {
  if (forced.strength && !(forced.policy && manoeuvre::takes_strength(*forced.policy))) {
    return Error{Error::Code::out_of_range, "--strength: only of --policy 0"};
  }
  if (forced.target_speed && !(forced.policy && manoeuvre::brakes_to_speed(*forced.policy))) {
    return Error{Error::Code::out_of_range, "--target-speed: only of --policy 3 and 4"};
  }
  if (!forced.policy) {
    return std::optional<manoeuvre::Plan>();
  }
  return std::optional(manoeuvre::Plan{*forced.policy, forced.target_speed, forced.strength});
}

}  // namespace saca::runs

#pragma once

#include "saca/manoeuvre/plan.h"
#include "saca/world/road.h"
#include "saca/world/scene.h"

namespace saca::decide {

/// Does it matter for the rest of a plan when and where it began? Of braking, however hard, and of
/// doing nothing, what is left is what begins now.
[[nodiscard]] constexpr bool has_past(const manoeuvre::Plan& plan) {
  return plan.policy != manoeuvre::PolicyId::aeb &&
         plan.policy != manoeuvre::PolicyId::no_intervention;
}

/// A plan that is being carried out. Trivially copyable.
struct UnderWay {
  manoeuvre::Plan plan;
  double begun = 0.0;   ///< [s], in the scene's time
  world::EgoState ego;  ///< then
  world::Road road;     ///< likewise
  double grip = 0.9;    ///< as it was believed then [-]

  bool operator==(const UnderWay&) const = default;
};

}  // namespace saca::decide

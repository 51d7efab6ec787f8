#pragma once

#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::reflex {

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

}  // namespace saca::reflex

#pragma once

#include <array>

#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/unknown.h"
#include "saca/outcome/outcome.h"
#include "saca/preview/situation.h"
#include "saca/world/scene.h"

namespace saca::loop {

/// What one policy would have led to, knowing what the others really did.
struct Hindsight {
  preview::PolicyFacts facts;
  outcome::Course course;  ///< to its end; empty when refused
};

/// All eight policies, begun in the scene at the trigger, among others who move as they truly
/// would, on the true grip.
/// @param at_trigger  the truth but for `grip`, which is what the ego takes the road for
/// @param grip        true friction coefficient
/// @param unknown     what else the ego's controller does not know; its grip is a factor of `grip`
[[nodiscard]] std::array<Hindsight, manoeuvre::num_policies> hindsight(
    const world::Scene& at_trigger, const outcome::Others& others, double grip,
    const manoeuvre::Car& car, const outcome::HarmModel& harm,
    const manoeuvre::Unknown& unknown = {});

}  // namespace saca::loop

#pragma once

#include <array>
#include <span>

#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/drive.h"
#include "saca/outcome/outcome.h"
#include "saca/preview/situation.h"
#include "saca/world/scene.h"

namespace saca::loop {

/// What one policy would have led to, knowing what the others really did.
struct Hindsight {
  preview::PolicyFacts facts;
  manoeuvre::EgoMotion motion;  ///< up to the contact, or the end; empty when refused
};

/// All eight policies, begun in the scene at the trigger, against the true tracks on the true grip.
/// @param tracks  true motion, one per actor of the scene
[[nodiscard]] std::array<Hindsight, manoeuvre::num_policies> hindsight(
    const world::Scene& at_trigger, std::span<const world::Track> tracks, double grip,
    const manoeuvre::Car& car, const outcome::HarmModel& harm);

}  // namespace saca::loop

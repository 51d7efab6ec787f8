#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "saca/intent/intention.h"
#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/plan.h"
#include "saca/outcome/outcome.h"
#include "saca/preview/situation.h"
#include "saca/preview/threat.h"

namespace saca::preview {

constexpr std::size_t max_situations = 3;

/// The likely situations at the trigger that are in conflict, likeliest first, at most three, with
/// all their facts.
///
/// Every combination of likely intentions of those actors that may come into conflict is one
/// situation (the 24 likeliest are looked at); the others do what is likeliest for them. The ego
/// goes on as it does until T1 before the conflict. Empty when no combination is in conflict within
/// T2.
///
/// Source: the paper, section IV-C, and reasoning in docs/architecture.md. Tens of milliseconds:
/// each policy is driven with full dynamics.
[[nodiscard]] std::vector<Situation> situations(const world::Scene& scene,
                                                const Thresholds& thresholds,
                                                const manoeuvre::Car& car,
                                                const outcome::HarmModel& harm);

/// What each policy ends in when it begins in `scene` and the actors follow their tracks, those
/// behind the ego but react to it: see with_reacting_followers.
[[nodiscard]] std::array<PolicyFacts, manoeuvre::num_policies> policy_facts(
    const world::Scene& scene, const std::vector<world::Track>& tracks, const manoeuvre::Car& car,
    const outcome::HarmModel& harm);

/// The policy whose forecast is best by the one ordering; ties go to the milder.
[[nodiscard]] manoeuvre::PolicyId best_by_forecast(
    const std::array<PolicyFacts, manoeuvre::num_policies>& facts);

}  // namespace saca::preview

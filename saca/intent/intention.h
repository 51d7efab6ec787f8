#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::intent {

/// What a road user is about to do: eq. 5 of the paper, in its order.
enum class Intention : std::uint8_t {
  maintain,     ///< M
  lane_left,    ///< LC
  lane_right,   ///< RC
  brake,        ///< FB
  brake_left,   ///< LB: braking while moving to the left
  brake_right,  ///< RB
};

constexpr std::size_t num_intentions = 6;

/// The paper's letters: "M", "LC", "RC", "FB", "LB", "RB".
[[nodiscard]] std::string_view name(Intention intention);

/// Probability of each intention, in the order of the enumeration; they sum to 1.
using IntentPosterior = std::array<double, num_intentions>;

/// The likeliest intention.
[[nodiscard]] Intention likeliest(const IntentPosterior& posterior);

/// Probabilities from the actor's measured acceleration and lateral motion, by a stated rule: see
/// the source. Obstacles and actors at rest maintain.
[[nodiscard]] IntentPosterior posterior(const world::Scene& scene, const world::Actor& actor);

/// The actor's motion under an intention, from its state in the scene, at 50 ms steps.
/// @param horizon  [s], > 0
[[nodiscard]] world::Track predicted_track(const world::Scene& scene, const world::Actor& actor,
                                           Intention intention, double horizon);

}  // namespace saca::intent

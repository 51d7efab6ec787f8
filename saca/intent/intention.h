#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "saca/world/scene.h"

namespace saca::intent {

/// What a road user is about to do: eq. 5 of the paper, in its order.
enum class Intention : std::uint8_t {
  maintain,     ///< M
  lane_left,    ///< LC
  lane_right,   ///< RC
  brake,        ///< FB
  brake_left,   ///< LB: braking while changing to the left
  brake_right,  ///< RB
};

constexpr std::size_t num_intentions = 6;
constexpr std::array<Intention, num_intentions> all_intentions{
    Intention::maintain, Intention::lane_left,  Intention::lane_right,
    Intention::brake,    Intention::brake_left, Intention::brake_right};

/// Those that vehicles have.
constexpr std::array<Intention, 6> vehicle_intentions = all_intentions;

/// Those under which a road user slows down.
constexpr std::array<Intention, 3> braking_intentions{Intention::brake, Intention::brake_left,
                                                      Intention::brake_right};

/// The paper's letters: "M", "LC", "RC", "FB", "LB", "RB".
[[nodiscard]] std::string_view name(Intention intention);

/// Probability of each intention, in the order of the enumeration; they sum to 1.
using IntentPosterior = std::array<double, num_intentions>;

/// The likeliest intention; among equals the first.
[[nodiscard]] Intention likeliest(const IntentPosterior& posterior);

/// Probabilities from what is measured now: deceleration along the actor's course, and its lateral
/// speed across the lane (of an actor that crosses the lane: the turn of its own course).
///
/// P(brakes) rises from 3 % (10 % for those who cross: they may give way) to 95 % about 2 m/s^2 of
/// deceleration; P(moves left), P(moves right) rise from 2 % to 90 % about 0.5 m/s of lateral
/// speed; the two are taken as independent. All are assumptions, but for 2 m/s^2, the project's own
/// mark of braking. Obstacles and actors at rest maintain; pedestrians only maintain or stop.
[[nodiscard]] IntentPosterior posterior(const world::Scene& scene, const world::Actor& actor);

}  // namespace saca::intent

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "saca/base/world/scene.h"

namespace saca::intent {

/// What a road user is about to do: eq. 5 of the paper, in its order; then what only pedestrians
/// and cyclists do.
enum class Intention : std::uint8_t {
  maintain,     ///< M
  lane_left,    ///< LC
  lane_right,   ///< RC
  brake,        ///< FB
  brake_left,   ///< LB: braking while changing to the left
  brake_right,  ///< RB
  stop,         ///< comes to rest where it is
  cross,        ///< turns to cross the ego's lane, or starts to
};

constexpr std::size_t num_intentions = 8;
constexpr std::array<Intention, num_intentions> all_intentions{
    Intention::maintain,   Intention::lane_left,   Intention::lane_right, Intention::brake,
    Intention::brake_left, Intention::brake_right, Intention::stop,       Intention::cross};

/// Those of vehicles: cars, vans, trucks, motorcycles.
constexpr std::array<Intention, 6> vehicle_intentions{
    Intention::maintain, Intention::lane_left,  Intention::lane_right,
    Intention::brake,    Intention::brake_left, Intention::brake_right};
/// Those of VRUs: pedestrians and cyclists.
constexpr std::array<Intention, 3> vru_intentions{Intention::maintain, Intention::stop,
                                                  Intention::cross};

/// A pedestrian or a cyclist.
[[nodiscard]] bool is_vru(world::ActorKind kind);

/// What a road user of this kind may intend, in the order of the enumeration; an obstacle only
/// maintains.
[[nodiscard]] std::span<const Intention> intentions_of(world::ActorKind kind);

/// It slows down: FB, LB, RB and stop.
[[nodiscard]] bool is_braking(Intention intention);

/// The paper's letters, "M", "LC", "RC", "FB", "LB", "RB"; and "stop", "cross".
[[nodiscard]] std::string_view name(Intention intention);

/// Probability of each intention, in the order of the enumeration; they sum to 1.
using IntentPosterior = std::array<double, num_intentions>;

/// The likeliest intention; among equals the first.
[[nodiscard]] Intention likeliest(const IntentPosterior& posterior);

}  // namespace saca::intent

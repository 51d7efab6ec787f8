#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/parameter_perturbation.h"

namespace saca::scenario {

/// How one actor differs from what its scenario says.
struct ActorChance {
  double ahead = 0.0;  ///< of where it is, all along, in the direction of its heading [m]
  double aside = 0.0;  ///< likewise to its left [m]
  double speed = 1.0;  ///< factor from `Chance::from` on: it runs through its motion so much faster
  double delay = 0.0;  ///< of what it begins at a time; never before 0 [s]
  double strength = 1.0;  ///< factor of its own accelerations
  double reaction = 1.0;  ///< factor of a reacting driver's reaction time
  /// Which of several things it does, in [0, 1); nullopt: what the scenario names.
  std::optional<double> choice;
};

/// One draw of everything that a scenario leaves to chance. As it stands, nothing: the scenario is
/// played as written.
struct Chance {
  manoeuvre::ParameterPerturbation car;  ///< of the ego and its road
  double from = 0.0;                     ///< when the actors' speeds begin to differ [s]
  std::array<ActorChance, world::max_actors> actors{};  ///< by index into Scenario::actors
  std::uint64_t perception = 0;                         ///< seed of what the sensors get wrong
};

/// Standard deviations of what an actor does; draws beyond three of them are taken as three.
/// All are assumptions: what a tracker still gets wrong at the trigger, and how evenly people
/// drive.
constexpr ActorChance actor_sd{
    .ahead = 0.2, .aside = 0.1, .speed = 0.03, .delay = 0.1, .strength = 0.1, .reaction = 0.25};

/// The generator of draw `number` of the series `seed`: neighbouring seeds and numbers give streams
/// that have nothing in common.
[[nodiscard]] std::mt19937_64 generator(std::uint64_t seed, std::uint64_t number);

/// Draw `number` of the series `seed`. Common random numbers: the same two give the same draw for
/// every policy, and draws of different numbers are independent.
/// @param from  when the actors' speeds begin to differ [s], >= 0
[[nodiscard]] Chance draw_chance(std::uint64_t seed, std::uint64_t number, double from);

}  // namespace saca::scenario

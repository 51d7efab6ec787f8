#pragma once

#include <functional>
#include <optional>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/avoidance.h"

namespace saca::learned_danger {

/// What is demanded at a look, `time` [s] after the first.
using Policy = std::function<manoeuvre::Demand(const State&, double time)>;

/// The demand, all around the grip, half of it or none, after which Q_h beside all obstacles is
/// least.
/// @param state  with one obstacle or more
[[nodiscard]] manoeuvre::Demand least_q(const Network& network, const world::Footprint& body,
                                        const State& state);

/// Going straight on, or else braking straight, where that leaves 1 m, and what is driven in 0.2 s,
/// beside all obstacles: for that nothing need be learnt, and it hardly ever goes wrong, where all
/// the grip across can end in a spin. nullopt: neither leaves as much.
/// @param limits  of the car; the state's grip is taken
[[nodiscard]] std::optional<manoeuvre::Demand> straight_evasion(const danger::Avoidance& limits,
                                                                const world::Footprint& body,
                                                                const State& state);

/// How a car evades: straight where that is enough, else by the least Q_h.
/// @param state  with one obstacle or more
[[nodiscard]] manoeuvre::Demand evasion(const danger::Avoidance& limits, const Network& network,
                                        const world::Footprint& body, const State& state);

/// V_h beside all obstacles [m].
[[nodiscard]] double joint_v(const Network& network, const world::Footprint& body,
                             const State& state);
/// The highest V_h of the obstacles, each by itself [m].
[[nodiscard]] double highest_single_v(const Network& network, const world::Footprint& body,
                                      const State& state);

/// Where a situation starts: the car, exactly, and what it is to miss.
struct Situation {
  vehicle::VehicleState car;
  double grip = 0.9;
  StaticVector<Obstacle, most_obstacles> obstacles;
};
/// As seen at its start.
[[nodiscard]] State state_of(const manoeuvre::Car& car, const Situation& situation);

/// The highest h [m] on the way when the full vehicle is driven by a policy until the situation is
/// settled, at most to the horizon, met every 20 ms.
[[nodiscard]] double highest_h(const manoeuvre::Car& car, const world::Footprint& body,
                               const Situation& situation, const Policy& policy);

}  // namespace saca::learned_danger

#pragma once

#include <functional>

#include "saca/danger/network.h"
#include "saca/danger/state.h"
#include "saca/manoeuvre/car.h"
#include "saca/manoeuvre/demand.h"
#include "saca/vehicle/vehicle.h"
#include "saca/world/footprint.h"

namespace saca::danger {

/// What is demanded at a look, `time` [s] after the first.
using Policy = std::function<manoeuvre::Demand(const State&, double time)>;

/// The demand, all around the grip, half of it or none, after which Q_h beside all obstacles is
/// least.
/// @param state  with one obstacle or more
[[nodiscard]] manoeuvre::Demand least_q(const Network& network, const world::Footprint& body,
                                        const State& state);

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

}  // namespace saca::danger

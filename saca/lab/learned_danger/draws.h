#pragma once

#include <functional>
#include <optional>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/random.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::learned_danger {

/// Whether the ego can keep h at or below a level [m] beside an obstacle, by whatever knows it
/// about: says where starts lie near the boundary between what can be evaded and what cannot.
using CanStayBelow = std::function<bool(double level, const Obstacle& obstacle)>;

/// Where and how the ego of a data set starts: at 0 to 40 m/s, after up to a second of any demands,
/// so that it already turns, slides, brakes.
/// @param grip  of the road [-], in [0.2, 1.0]
[[nodiscard]] vehicle::VehicleState drawn_start(const manoeuvre::Car& car, double grip,
                                                Random& random);

/// What of a body and its motion does not depend on the ego: a pedestrian, cyclist, car, truck or
/// articulated truck, some 10 % larger or smaller; three of ten stand; some brake, speed up or turn
/// as much as such a body may. At the world's origin.
[[nodiscard]] Obstacle drawn_obstacle(Random& random);

/// Puts the obstacle anywhere within 100 m, mostly ahead; it does not touch the ego.
/// @param body  of the ego
[[nodiscard]] Obstacle placed_anywhere(const world::Footprint& body, const State& state,
                                       Obstacle obstacle, Random& random);

/// Puts it within 2 m of the boundary: as near as leaves the ego a way to keep h at or below a
/// number drawn between -2 and 2 m.
/// @return  nullopt: at the bearing and on the course that were drawn there is no such place
[[nodiscard]] std::optional<Obstacle> placed_near_boundary(const world::Footprint& body,
                                                           const State& state, Obstacle obstacle,
                                                           const CanStayBelow& can_stay_below,
                                                           Random& random);

/// One to three obstacles: half of the draws have one, three of ten two.
struct DrawnObstacles {
  StaticVector<Obstacle, most_obstacles> obstacles;
  bool is_near = false;  ///< one at least is within 2 m of the boundary
};
/// @param near_share  of the draws, whose obstacles are put near the boundary where that can be
/// done
[[nodiscard]] DrawnObstacles drawn_obstacles(const world::Footprint& body, const State& state,
                                             const CanStayBelow& can_stay_below, double near_share,
                                             Random& random);

}  // namespace saca::learned_danger

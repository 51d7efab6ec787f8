#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/ego.h"
#include "saca/lab/learned_danger/obstacle.h"
#include "saca/thinking/danger/danger.h"

namespace saca::learned_danger {

constexpr std::size_t most_obstacles = 3;

/// V_h and Q_h look so many looks ahead, 6 s: longer than previews (T2 = 5.5 s), and longer nobody
/// turns or accelerates as he does now.
constexpr int horizon_looks = 60;

/// x of the paper's equations 1 to 3: a car that moves on a road, and what it is to miss.
struct State {
  Ego ego;
  double grip = 0.9;  ///< of the road [-]
  StaticVector<Obstacle, most_obstacles> obstacles;
};

/// The same seen in a mirror.
[[nodiscard]] State mirrored(const State& state);

/// Its obstacles go on for a while (obstacle.h); the ego stays where it is.
/// @param time  [s], >= 0
void move_obstacles(State& state, double time);

/// h: how deep the ego stands in the obstacle that it stands in deepest; less than 0: minus the
/// distance from the nearest [m]. Minus infinity without obstacles.
/// @param body  of the ego, about its centre of mass
[[nodiscard]] double intrusion(const world::Footprint& body, const State& state);

/// Whether nothing can happen any more: at rest beside obstacles that stand or lead away, or apart
/// from all, and only getting farther where all go on, the ego straight. V is then h.
[[nodiscard]] bool is_settled(const world::Footprint& body, const State& state);

/// Ego and one obstacle as the avoidance problem with constant velocities has them
/// (danger/danger.h): the ego's course for its heading, the obstacle's present speed for all time.
[[nodiscard]] danger::Meeting meeting_of(const world::Footprint& body, const State& state,
                                         const Obstacle& obstacle);

constexpr std::size_t num_ego_features = 9;
constexpr std::size_t num_obstacle_features = 10;
constexpr std::size_t num_features = num_ego_features + most_obstacles * num_obstacle_features;

/// A state as numbers, in SI units and radians, seen from the ego: nothing of it depends on where
/// in the world it is. An obstacle that is not there is all 0.
using Observation = std::array<float, num_features>;
[[nodiscard]] Observation observation(const State& state);
/// How many obstacles are in there.
[[nodiscard]] std::size_t num_obstacles_of(const Observation& seen);
/// What an observation says of one of them; its shape it does not say. The ego is at the origin.
[[nodiscard]] Obstacle seen_obstacle(const Observation& seen, std::size_t obstacle,
                                     world::Shape shape = world::Shape::box);
/// Everything that an observation says.
[[nodiscard]] State seen_state(const Observation& seen, world::Shape shape = world::Shape::box);
/// "v_x", ..., "obstacle0.x", ...: one for each number.
[[nodiscard]] const std::vector<std::string>& feature_names();

}  // namespace saca::learned_danger

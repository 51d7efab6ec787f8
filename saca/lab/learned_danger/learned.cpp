#include "saca/lab/learned_danger/learned.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "saca/base/core/fnv.h"
#include "saca/lab/learned_danger/acting.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/perceived.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::learned_danger {
namespace {

constexpr double learnt_to_speed = 40.0;  // [m/s]
constexpr double least_grip = 0.2;
constexpr double most_grip = 1.0;
constexpr double learnt_to_distance = 100.0;  // [m]
constexpr double told_well_to = 14.0;         // [m]

/// Lengths and widths of drawn bodies (draws.h).
bool has_known_size(const world::Footprint& body) {
  return body.length >= 0.4 && body.length <= 18.2 && body.width >= 0.4 && body.width <= 2.9;
}

bool is_finite(const danger::Motion& motion) {
  return std::isfinite(motion.yaw_rate) && std::isfinite(motion.sideslip) &&
         std::isfinite(motion.a_B.x) && std::isfinite(motion.a_B.y);
}

bool moves_as_drawn(const Obstacle& obstacle) {
  constexpr double strongest = 9.0;  // [m/s^2], braking
  constexpr double drives = 4.0;
  constexpr double sideways = 9.0;
  return obstacle.speed <= learnt_to_speed && obstacle.acceleration >= -strongest &&
         obstacle.acceleration <= drives &&
         std::abs(obstacle.curvature) * obstacle.speed * obstacle.speed <= sideways;
}

/// The state, seen in the obstacle's frame.
State state_of(const manoeuvre::Car& car, const danger::Meeting& meeting,
               const danger::Motion& motion) {
  const auto& [x, y, course, speed] = meeting.state;
  State state;
  state.grip = std::min(meeting.grip, most_grip);
  state.ego = perceived_ego(car, {.X_WB = {{x, y}, course - motion.sideslip},
                                  .v_B = rotated(Vec2{speed, 0.0}, motion.sideslip),
                                  .yaw_rate = motion.yaw_rate,
                                  .a_B = motion.a_B});
  state.obstacles.push_back(perceived_obstacle(meeting, motion, Pose{}));
  return state;
}

}  // namespace

danger::LearnedValue learned_value(std::shared_ptr<const Network> network, const Margins& margins,
                                   const manoeuvre::Car& car) {
  return
      [network = std::move(network), margins, car, body = manoeuvre::footprint(car),
       limits = danger::avoidance_of(car, 1.0)](
          const danger::Meeting& meeting, const danger::Motion& motion) -> std::optional<double> {
        const State state = state_of(car, meeting, motion);
        const Obstacle& obstacle = state.obstacles[0];
        const double speed = meeting.state[3];
        const double distance = std::hypot(meeting.state[0], meeting.state[1]);
        if (!is_finite(motion) || !has_known_size(obstacle.body) || !moves_as_drawn(obstacle) ||
            speed > learnt_to_speed || meeting.grip < least_grip || distance > learnt_to_distance) {
          return std::nullopt;
        }
        const std::array<SeenByNet, 1> seen{seen_by_net(body, observation(state), 0)};
        const double told = network->joint_value(seen);
        if (told <= -told_well_to) {
          return std::nullopt;
        }
        const bool is_straight = straight_evasion(limits, body, state).has_value();
        const double margin = margins.at(is_straight, speed, state.grip, 1);
        if (margin < Margins::none) {
          return told + margin;
        }
        return told < 0.0 ? std::nullopt : std::optional(told);  // danger needs no margin
      };
}

std::string vehicle_word(const vehicle::Vehicle& car) {
  Fnv hash;
  hash.add_doubles(car);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace saca::learned_danger

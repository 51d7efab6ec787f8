#include "saca/lab/learned_danger/state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger {
namespace {

Pose mirrored(const Pose& X) {
  return {{X.p.x, -X.p.y}, -X.yaw};
}

Obstacle mirrored(Obstacle obstacle) {
  obstacle.X_WO = mirrored(obstacle.X_WO);
  obstacle.curvature = -obstacle.curvature;
  return obstacle;
}

/// The ego after it has gone straight on at its velocity.
Pose straight_on(const Ego& ego, double time) {
  return {ego.X_WB.p + time * rotated(ego.v_B, ego.X_WB.yaw), ego.X_WB.yaw};
}

}  // namespace

State mirrored(const State& state) {
  State other = state;
  other.ego.X_WB = mirrored(state.ego.X_WB);
  other.ego.v_B.y = -state.ego.v_B.y;
  other.ego.a_B.y = -state.ego.a_B.y;
  other.ego.yaw_rate = -state.ego.yaw_rate;
  other.ego.steering = -state.ego.steering;
  for (Obstacle& obstacle : other.obstacles) {
    obstacle = mirrored(obstacle);
  }
  return other;
}

void move_obstacles(State& state, double time) {
  for (Obstacle& obstacle : state.obstacles) {
    obstacle = after(obstacle, time);
  }
}

double intrusion(const world::Footprint& body, const State& state) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Obstacle& obstacle : state.obstacles) {
    deepest =
        std::max(deepest, danger::intrusion(body, state.ego.X_WB, obstacle.body, obstacle.X_WO));
  }
  return deepest;
}

bool is_settled(const world::Footprint& body, const State& state) {
  // Convex shapes on straight ways, once they get farther, get farther for good; arcs may come
  // back. The first step is short, or they could pass one another within it.
  constexpr double first_step = 0.005;  // [s]
  constexpr double step = 0.05;
  constexpr int steps = 100;         // later nobody goes on as now
  constexpr double rounding = 1e-6;  // [m]
  for (const Obstacle& obstacle : state.obstacles) {
    double before = danger::intrusion(body, state.ego.X_WB, obstacle.body, obstacle.X_WO);
    if (before > 0.0) {
      return false;
    }
    for (int i = 0; i <= steps; ++i) {
      const double time = i == 0 ? first_step : step * i;
      const double then = danger::intrusion(body, straight_on(state.ego, time), obstacle.body,
                                            after(obstacle, time).X_WO);
      if (then > before + rounding) {
        return false;
      }
      before = then;
    }
  }
  return true;
}

danger::Meeting meeting_of(const world::Footprint& body, const State& state,
                           const Obstacle& obstacle) {
  const Vec2 p_O = inverse(obstacle.X_WO) * state.ego.X_WB.p;
  const double speed = norm(state.ego.v_B);
  return {.ego = body,
          .obstacle = obstacle.body,
          .grip = state.grip,
          .obstacle_speed = obstacle.speed,
          .state = {p_O.x, p_O.y, wrap_angle(course(state.ego) - obstacle.X_WO.yaw), speed}};
}

Observation observation(const State& state) {
  Observation seen{};
  std::size_t next = 0;
  const auto add = [&](double number) { seen[next++] = static_cast<float>(number); };
  const Ego& ego = state.ego;
  for (const double number : {ego.v_B.x, ego.v_B.y, ego.yaw_rate, ego.a_B.x, ego.a_B.y,
                              ego.steering, ego.braking, ego.driving, state.grip}) {
    add(number);
  }
  const Pose X_BW = inverse(ego.X_WB);
  for (const Obstacle& obstacle : state.obstacles) {
    const Pose X_BO = X_BW * obstacle.X_WO;
    for (const double number :
         {1.0, X_BO.p.x, X_BO.p.y, std::cos(X_BO.yaw), std::sin(X_BO.yaw), obstacle.speed,
          obstacle.acceleration, obstacle.curvature, obstacle.body.length, obstacle.body.width}) {
      add(number);
    }
  }
  return seen;
}

std::size_t num_obstacles_of(const Observation& seen) {
  std::size_t count = 0;
  while (count < most_obstacles && seen[num_ego_features + count * num_obstacle_features] != 0.0F) {
    ++count;
  }
  return count;
}

Obstacle seen_obstacle(const Observation& seen, std::size_t obstacle, world::Shape shape) {
  const std::size_t first = num_ego_features + obstacle * num_obstacle_features;
  expects(obstacle < most_obstacles && seen[first] != 0.0F, "an obstacle that is there");
  const auto number = [&](std::size_t i) { return static_cast<double>(seen[first + i]); };
  Obstacle other;
  other.X_WO = {{number(1), number(2)}, std::atan2(number(4), number(3))};
  other.speed = number(5);
  other.acceleration = number(6);
  other.curvature = number(7);
  other.body = {.shape = shape, .length = number(8), .width = number(9)};
  return other;
}

State seen_state(const Observation& seen, world::Shape shape) {
  const auto number = [&](std::size_t i) { return static_cast<double>(seen[i]); };
  State state{.ego = {.v_B = {number(0), number(1)},
                      .yaw_rate = number(2),
                      .a_B = {number(3), number(4)},
                      .steering = number(5),
                      .braking = number(6),
                      .driving = number(7)},
              .grip = number(8)};
  for (std::size_t k = 0; k < num_obstacles_of(seen); ++k) {
    state.obstacles.push_back(seen_obstacle(seen, k, shape));
  }
  return state;
}

const std::vector<std::string>& feature_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"v_x",      "v_y",     "yaw_rate", "a_x", "a_y",
                                 "steering", "braking", "driving",  "grip"};
    for (std::size_t k = 0; k < most_obstacles; ++k) {
      for (const char* what : {"there", "x", "y", "cos_yaw", "sin_yaw", "speed", "acceleration",
                               "curvature", "length", "width"}) {
        all.push_back("obstacle" + std::to_string(k) + "." + what);
      }
    }
    return all;
  }();
  return names;
}

}  // namespace saca::learned_danger

#include "saca/thinking/danger/avoidance_ahead.h"

#include "saca/base/core/angle.h"

namespace saca::danger {

AvoidanceAhead::Row AvoidanceAhead::row(const std::array<double, 4>& state) const {
  const double turned = state[2];
  const double speed = state[3];
  return {car.obstacle_speed * std::cos(turned) - speed, car.obstacle_speed * std::sin(turned),
          state[1], limits_at(car, speed)};
}

State seen_by_ego(const State& state) {
  const double c = std::cos(state[2]);
  const double s = std::sin(state[2]);
  return {-(c * state[0] + s * state[1]), s * state[0] - c * state[1], wrap_angle(-state[2]),
          state[3]};
}

State slopes_in_obstacle_frame(const State& seen, const State& slopes) {
  const double c = std::cos(seen[2]);
  const double s = -std::sin(seen[2]);  // of the course, which is -turned
  return {s * slopes[1] - c * slopes[0], -s * slopes[0] - c * slopes[1],
          seen[1] * slopes[0] - seen[0] * slopes[1] - slopes[2], slopes[3]};
}

}  // namespace saca::danger

#include "saca/lab/scenario/turn.h"

#include <cmath>
#include <numbers>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"

namespace saca::scenario {
namespace {

Vec2 direction(double heading) {
  return {std::cos(heading), std::sin(heading)};
}

}  // namespace

double Turn::arc_length() const {
  return radius * std::abs(angle);
}

Pose Turn::pose(double along) const {
  if (along <= 0.0) {
    return {along * direction(heading), wrap_angle(heading)};
  }
  const double side = angle > 0.0 ? 1.0 : -1.0;
  const double turned = side * std::min(along, arc_length()) / radius;
  const double yaw = heading + turned;
  // The centre of the circle lies across the heading, to the side that is turned to.
  const double across = side * 0.5 * std::numbers::pi;
  const Vec2 on_arc = radius * (direction(heading + across) - direction(yaw + across));
  const double beyond = std::max(0.0, along - arc_length());
  return {on_arc + beyond * direction(yaw), wrap_angle(yaw)};
}

Recording recording_of(const Turn& turn, Vec2 begins, double at_arc, double speed,
                       double duration) {
  expects(turn.radius > 0.0 && turn.angle != 0.0, "a turn has a radius and an angle");
  expects(speed > 0.0 && duration > 0.0, "speed and duration > 0");
  constexpr double step = 0.05;  // [s]: at 10 m/s on 5 m, 6 degrees
  const auto num_steps = static_cast<int>(std::ceil(duration / step));
  Recording recording;
  recording.reserve(static_cast<std::size_t>(num_steps) + 1);
  for (int k = 0; k <= num_steps; ++k) {
    const double time = step * k;
    const double along = speed * (time - at_arc);
    Pose pose = turn.pose(along);
    pose.p = pose.p + begins;
    const bool turns = along > 0.0 && along < turn.arc_length();
    const double yaw_rate = turns ? std::copysign(speed / turn.radius, turn.angle) : 0.0;
    recording.push_back({.time = time, .X_WA = pose, .speed = speed, .yaw_rate = yaw_rate});
  }
  return recording;
}

}  // namespace saca::scenario

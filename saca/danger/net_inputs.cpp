#include "saca/danger/net_inputs.h"

#include <algorithm>
#include <cmath>

#include "saca/core/contract.h"
#include "saca/reach/intrusion.h"
#include "saca/vehicle/vehicle.h"

namespace saca::danger {
namespace {

constexpr std::array<double, 3> times_ahead{0.5, 1.0, 2.0};  // [s]

/// h, the nearer the finer.
double scaled(double h) {
  return 0.1 * h;
}

double finely(double h) {
  return std::clamp(0.5 * h, -2.0, 2.0);
}

/// A straight line's passing by another's: when it is nearest [s], and how far then, to the left.
struct Passing {
  double time;
  double left;
};

Passing passing(const Vec2& p, const Vec2& v_rel) {
  constexpr double latest = 8.0;  // [s]
  const double square = dot(v_rel, v_rel);
  if (square < 1e-6) {
    return {latest, 0.0};
  }
  const double time = std::clamp(-dot(p, v_rel) / square, 0.0, latest);
  return {time, (v_rel.x * p.y - v_rel.y * p.x) / std::sqrt(square)};
}

}  // namespace

SeenByNet seen_by_net(const world::Footprint& body, const Observation& seen, std::size_t obstacle,
                      world::Shape shape) {
  const auto number = [&](std::size_t i) { return static_cast<double>(seen[i]); };
  const Vec2 v_B{number(0), number(1)};
  const double grip = number(8);
  const Obstacle other = seen_obstacle(seen, obstacle, shape);
  const std::size_t first = num_ego_features + obstacle * num_obstacle_features;
  const Vec2 heading{number(first + 3), number(first + 4)};
  const Vec2 p = other.X_WO.p;
  const Vec2 v_rel = other.speed * heading - v_B;
  const double h = reach::intrusion(body, Pose{}, other.body, other.X_WO);
  const Passing pass = passing(p, v_rel);
  const double speed = norm(v_B);
  const double most = grip * vehicle::gravity;
  const double closing = std::max(0.0, -dot(p, v_rel) / std::max(0.1, norm(p)));
  const double needed = closing * closing / (2.0 * std::max(0.5, -h) * most);

  SeenByNet result;
  result.h = h;
  std::size_t next = 0;
  const auto add = [&](double x) {
    constexpr double largest = 4.0;  // what is rarer than that tells nothing more by its size
    result.inputs[next++] = static_cast<float>(std::clamp(x, -largest, largest));
  };
  add(v_B.x / 20.0);
  add(v_B.y / 3.0);
  add(number(2) / 0.5);  // yaw rate
  add(number(3) / 8.0);  // acceleration
  add(number(4) / 8.0);
  add(number(5) / 0.2);  // steering
  add(number(6) / 8.0);  // brakes
  add(number(7) / 4.0);  // motor
  add(grip);
  add(p.x / 30.0);
  add(p.y / 15.0);
  add(std::tanh(p.x / 5.0));
  add(std::tanh(p.y / 2.0));
  add(heading.x);
  add(heading.y);
  add(v_rel.x / 20.0);
  add(v_rel.y / 10.0);
  add(other.speed / 20.0);
  add(other.acceleration / 5.0);
  add(other.curvature * other.speed * other.speed / 4.0);
  add(other.body.length / 5.0);
  add(other.body.width / 2.0);
  add(scaled(h));
  add(finely(h));
  for (const double time : times_ahead) {
    const Obstacle then = after(other, time);
    const double h_then = reach::intrusion(body, Pose{time * v_B, 0.0}, then.body, then.X_WO);
    add(scaled(h_then));
  }
  add(pass.time / 3.0);
  add(std::clamp(pass.left / 5.0, -3.0, 3.0));
  add(speed * speed / (2.0 * most) / 30.0);
  add(std::min(3.0, needed));
  add(closing / 10.0);
  expects(next == num_net_inputs, "all inputs");
  return result;
}

const std::vector<std::size_t>& mirrored_inputs() {
  static const std::vector<std::size_t> all{1, 2, 4, 5, 10, 12, 14, 16, 19, 28};
  return all;
}

}  // namespace saca::danger

#include "saca/lab/learned_danger/net_inputs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger {
namespace {

constexpr std::array<double, 3> times_ahead{0.5, 1.0, 2.0};        // [s]
constexpr std::array<double, 3> times_of_evasions{0.8, 1.6, 2.6};  // [s]

/// h, the nearer the finer.
double scaled(double h) {
  return 0.1 * h;
}

double finely(double h) {
  return std::clamp(0.5 * h, -2.0, 2.0);
}

/// Where an arc leads that the ego begins now, as a point mass whose body points along its course.
class Evasions {
 public:
  Evasions(const world::Footprint& body, const Vec2& v_B, double grip)
      : body_(body),
        speed_(norm(v_B)),
        most_(grip * vehicle::gravity),
        course_(speed_ > 0.0 ? std::atan2(v_B.y, v_B.x) : 0.0) {}

  /// h then, towards the obstacle as it is then.
  /// @param along, across  of the grip, > 0 ahead and to the left
  [[nodiscard]] double h(double along, double across, double time, const Obstacle& then) const {
    constexpr double tightest = 0.17;  // [1/m]
    const double square = std::max(0.01, speed_ * speed_);
    const Obstacle ego{.X_WO = {{}, course_},
                       .speed = speed_,
                       .acceleration = along * most_,
                       .curvature = std::clamp(across * most_ / square, -tightest, tightest)};
    return danger::intrusion(body_, after(ego, time).X_WO, then.body, then.X_WO);
  }

 private:
  world::Footprint body_;
  double speed_;
  double most_;
  double course_;
};

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
  const double h = danger::intrusion(body, Pose{}, other.body, other.X_WO);
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
    const double h_then = danger::intrusion(body, Pose{time * v_B, 0.0}, then.body, then.X_WO);
    add(scaled(h_then));
  }
  add(pass.time / 3.0);
  add(std::clamp(pass.left / 5.0, -3.0, 3.0));
  add(speed * speed / (2.0 * most) / 30.0);
  add(std::min(3.0, needed));
  add(closing / 10.0);
  const Evasions evasions(body, v_B, grip);
  for (const double time : times_of_evasions) {
    const Obstacle then = after(other, time);
    add(scaled(evasions.h(-1.0, 0.0, time, then)));
    for (const double braking : {0.0, -std::numbers::sqrt2 / 2.0}) {
      const double turning = std::sqrt(1.0 - braking * braking);
      const double left = evasions.h(braking, turning, time, then);
      const double right = evasions.h(braking, -turning, time, then);
      add(scaled(0.5 * (left + right)));
      add(finely(left - right));
    }
  }
  expects(next == num_net_inputs, "all inputs");
  return result;
}

const std::vector<std::size_t>& mirrored_inputs() {
  static const std::vector<std::size_t> all{1,  2,  4,  5,  10, 12, 14, 16,
                                            19, 28, 34, 36, 39, 41, 44, 46};
  return all;
}

}  // namespace saca::learned_danger

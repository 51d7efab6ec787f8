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

/// Puts one input after the other.
class Inputs {
 public:
  explicit Inputs(std::array<float, num_net_inputs>& inputs) : inputs_(inputs) {}

  void add(double x) {
    constexpr double largest = 4.0;  // what is rarer than that tells nothing more by its size
    inputs_[next_++] = static_cast<float>(std::clamp(x, -largest, largest));
  }
  [[nodiscard]] bool complete() const { return next_ == inputs_.size(); }

 private:
  std::array<float, num_net_inputs>& inputs_;
  std::size_t next_ = 0;
};

/// An ego and an obstacle, as the ego sees them.
struct EgoAndObstacle {
  world::Footprint body;
  Vec2 v_B;
  double grip;
  Obstacle other;
  Vec2 heading;  ///< of the obstacle's travel
  Vec2 v_rel;
  double h;

  [[nodiscard]] Vec2 p() const { return other.X_WO.p; }
  /// The greatest acceleration that the grip allows [m/s^2].
  [[nodiscard]] double most() const { return grip * vehicle::gravity; }
};

EgoAndObstacle pair_of(const world::Footprint& body, const Observation& seen, std::size_t obstacle,
                       world::Shape shape) {
  const auto number = [&](std::size_t i) { return static_cast<double>(seen[i]); };
  const std::size_t first = num_ego_features + obstacle * num_obstacle_features;
  const Vec2 v_B{number(0), number(1)};
  const Vec2 heading{number(first + 3), number(first + 4)};
  const Obstacle other = seen_obstacle(seen, obstacle, shape);
  return {.body = body,
          .v_B = v_B,
          .grip = number(8),
          .other = other,
          .heading = heading,
          .v_rel = other.speed * heading - v_B,
          .h = danger::intrusion(body, Pose{}, other.body, other.X_WO)};
}

void add_ego(const Observation& seen, Inputs& inputs) {
  // Of velocity and acceleration ahead and to the left with the yaw rate between them, of steering,
  // brakes, motor and grip.
  constexpr std::array<double, num_ego_features> unit{20.0, 3.0, 0.5, 8.0, 8.0, 0.2, 8.0, 4.0, 1.0};
  for (std::size_t i = 0; i < unit.size(); ++i) {
    inputs.add(static_cast<double>(seen[i]) / unit[i]);
  }
}

void add_obstacle(const EgoAndObstacle& pair, Inputs& inputs) {
  const Obstacle& other = pair.other;
  const Vec2 p = pair.p();
  inputs.add(p.x / 30.0);
  inputs.add(p.y / 15.0);
  inputs.add(std::tanh(p.x / 5.0));
  inputs.add(std::tanh(p.y / 2.0));
  inputs.add(pair.heading.x);
  inputs.add(pair.heading.y);
  inputs.add(pair.v_rel.x / 20.0);
  inputs.add(pair.v_rel.y / 10.0);
  inputs.add(other.speed / 20.0);
  inputs.add(other.acceleration / 5.0);
  inputs.add(other.curvature * other.speed * other.speed / 4.0);
  inputs.add(other.body.length / 5.0);
  inputs.add(other.body.width / 2.0);
  inputs.add(scaled(pair.h));
  inputs.add(finely(pair.h));
}

/// What comes if neither does anything, and what braking straight would need.
void add_future(const EgoAndObstacle& pair, Inputs& inputs) {
  for (const double time : times_ahead) {
    const Obstacle then = after(pair.other, time);
    const Pose ego{time * pair.v_B, 0.0};
    inputs.add(scaled(danger::intrusion(pair.body, ego, then.body, then.X_WO)));
  }
  const Vec2 p = pair.p();
  const Passing pass = passing(p, pair.v_rel);
  const double speed = norm(pair.v_B);
  const double closing = std::max(0.0, -dot(p, pair.v_rel) / std::max(0.1, norm(p)));
  const double needed = closing * closing / (2.0 * std::max(0.5, -pair.h) * pair.most());
  inputs.add(pass.time / 3.0);
  inputs.add(std::clamp(pass.left / 5.0, -3.0, 3.0));
  inputs.add(speed * speed / (2.0 * pair.most()) / 30.0);
  inputs.add(std::min(3.0, needed));
  inputs.add(closing / 10.0);
}

void add_evasions(const EgoAndObstacle& pair, Inputs& inputs) {
  const Evasions evasions(pair.body, pair.v_B, pair.grip);
  for (const double time : times_of_evasions) {
    const Obstacle then = after(pair.other, time);
    inputs.add(scaled(evasions.h(-1.0, 0.0, time, then)));
    for (const double braking : {0.0, -std::numbers::sqrt2 / 2.0}) {
      const double turning = std::sqrt(1.0 - braking * braking);
      const double left = evasions.h(braking, turning, time, then);
      const double right = evasions.h(braking, -turning, time, then);
      inputs.add(scaled(0.5 * (left + right)));
      inputs.add(finely(left - right));
    }
  }
}

}  // namespace

SeenByNet seen_by_net(const world::Footprint& body, const Observation& seen, std::size_t obstacle,
                      world::Shape shape) {
  const EgoAndObstacle pair = pair_of(body, seen, obstacle, shape);
  SeenByNet result;
  result.h = pair.h;
  Inputs inputs(result.inputs);
  add_ego(seen, inputs);
  add_obstacle(pair, inputs);
  add_future(pair, inputs);
  add_evasions(pair, inputs);
  expects(inputs.complete(), "all inputs");
  return result;
}

const std::vector<std::size_t>& mirrored_inputs() {
  static const std::vector<std::size_t> all{1,  2,  4,  5,  10, 12, 14, 16,
                                            19, 28, 34, 36, 39, 41, 44, 46};
  return all;
}

}  // namespace saca::learned_danger

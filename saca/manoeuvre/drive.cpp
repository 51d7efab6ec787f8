#include "saca/manoeuvre/drive.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "saca/core/contract.h"
#include "saca/manoeuvre/ride.h"

namespace saca::manoeuvre {
namespace {

constexpr int steps_per_pose = 10;
constexpr double slowest_lane_change = 5.0;  // [m/s]

// "<what> <value> <rest>"; std::format is not there yet.
std::string with_number(const char* pattern, double value) {
  std::array<char, 160> text{};
  (void)std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

/// Braking and doing nothing need nothing: they are what is left when all else is refused.
bool always_possible(PolicyId policy) {
  return policy == PolicyId::aeb || policy == PolicyId::no_intervention;
}

std::optional<std::string> wrong_target(const Plan& plan) {
  if (brakes_to_speed(plan.policy) != plan.target_speed.has_value()) {
    return std::string(name(plan.policy)) +
           (plan.target_speed ? " takes no target speed" : " needs a target speed");
  }
  if (plan.target_speed && !(*plan.target_speed >= 0.0 && *plan.target_speed <= fastest)) {
    return with_number("target speed must be 0 to 25 m/s, is %.2f", *plan.target_speed);
  }
  return std::nullopt;
}

std::optional<std::string> wrong_motion(const Car& car, const Plan& plan,
                                        const world::Scene& scene) {
  const world::EgoState& ego = scene.ego;
  if (!is_finite(ego.X_WB) || !is_finite(ego.v_B) || !std::isfinite(ego.yaw_rate) ||
      !is_finite(ego.a_B)) {
    return "the ego's state is not finite";
  }
  if (always_possible(plan.policy)) {
    return std::nullopt;
  }
  const SpeedRange range = drifts(plan.policy) ? drift_speeds(car.tuning.domain, scene.grip)
                                               : SpeedRange{slowest_lane_change, fastest};
  if (range.slowest > range.fastest) {
    return std::string(name(plan.policy)) +
           with_number(" is not possible at a grip of %.2f with this car", scene.grip);
  }
  if (!(ego.v_B.x >= range.slowest && ego.v_B.x <= range.fastest)) {
    return std::string(name(plan.policy)) + with_number(" needs a speed of %.4g", range.slowest) +
           with_number(" to %.4g m/s ahead", range.fastest) + with_number(", is %.2f", ego.v_B.x);
  }
  return std::nullopt;
}

std::optional<std::string> wrong_road(const Plan& plan, const world::Scene& scene) {
  const world::Road& road = scene.road;
  if (!is_finite(road.X_WL) || !std::isfinite(road.curvature) ||
      (!always_possible(plan.policy) && !(road.lane_width >= 2.0 && road.lane_width <= 6.0))) {
    return with_number("the road must be finite, its lane 2 to 6 m wide, is %.2f", road.lane_width);
  }
  // A swerve out of a bend adds to what the bend itself takes.
  const double most_share = drifts(plan.policy) ? 0.3 : 0.5;
  const double share = std::abs(road.curvature) * scene.ego.v_B.x * scene.ego.v_B.x /
                       (scene.grip * vehicle::gravity);
  if (!always_possible(plan.policy) && !(share <= most_share + 1e-9)) {
    return std::string(name(plan.policy)) +
           with_number(" allows a bend %.0f %% of the grip", 100.0 * most_share) +
           with_number(", this one takes %.0f %%", 100.0 * share);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> refusal(const Car& car, const Plan& plan, const world::Scene& scene) {
  if (index(plan.policy) >= num_policies) {
    return "no such policy";
  }
  if (auto problem = wrong_target(plan)) {
    return problem;
  }
  if (!(scene.grip > 0.0)) {
    return with_number("grip must be > 0, is %.3f", scene.grip);
  }
  if (!always_possible(plan.policy) && !(scene.grip >= 0.2 && scene.grip <= 1.0)) {
    return std::string(name(plan.policy)) +
           with_number(" needs a grip of 0.2 to 1.0, is %.3f", scene.grip);
  }
  if (auto problem = wrong_motion(car, plan, scene)) {
    return problem;
  }
  return wrong_road(plan, scene);
}

EgoMotion drive(const Car& car, const Plan& plan, const world::Scene& scene, double grip,
                double horizon, const Unknown& unknown) {
  expects(grip > 0.0 && grip <= 1.2, "grip in (0, 1.2]");
  expects(horizon >= 0.0 && horizon <= 3600.0, "horizon in [0, 3600] s");
  Ride ride(car, plan, scene, grip, unknown);
  const int num_poses =
      static_cast<int>(std::lround(horizon / (vehicle::usual_step * steps_per_pose)));
  EgoMotion motion;
  motion.track.start = scene.time;
  motion.track.step = vehicle::usual_step * steps_per_pose;
  const auto note = [&] {
    motion.track.X_WA.push_back(ride.state().X_WB);
    motion.v_B.push_back(ride.state().v_B);
    motion.yaw_rate.push_back(ride.state().yaw_rate);
  };
  note();
  motion.ended = ride.ended();
  for (int pose = 0; pose < num_poses && !motion.ended; ++pose) {
    for (int i = 0; i < steps_per_pose; ++i) {
      ride.step();
    }
    note();
    motion.ended = ride.ended();
  }
  return motion;
}

}  // namespace saca::manoeuvre

#include "saca/onboard/manoeuvre/drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/onboard/manoeuvre/ride.h"

namespace saca::manoeuvre {
namespace {

constexpr std::array<std::string_view, 9> refusal_names{
    "unknown policy", "target speed", "grip", "state of the ego", "grip",
    "speed",          "road",         "bend", "strength"};

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

bool takes_target(const Plan& plan) {
  return !plan.target_speed || (*plan.target_speed >= 0.0 && *plan.target_speed <= fastest);
}

bool has_right_strength(const Plan& plan) {
  return !plan.strength ||
         (takes_strength(plan.policy) && *plan.strength >= least_strength && *plan.strength <= 1.0);
}

SpeedRange speeds_of(const Car& car, const Plan& plan, double grip) {
  return drifts(plan.policy) ? drift_speeds(car.tuning.domain, grip)
                             : SpeedRange{slowest_lane_change, fastest};
}

/// A swerve out of a bend adds to what the bend itself takes: shares of the grip.
double most_share_of_bend(const Plan& plan) {
  return drifts(plan.policy) ? 0.3 : 0.5;
}

constexpr double least_share_of_swerve = 0.05;
bool leaves_grip_to_swerve(const Car& car, const Plan& plan, const world::Scene& scene) {
  return !changes_lane(plan.policy) || share_of_swerve(car, plan, scene) >= least_share_of_swerve;
}

std::string in_words(Refusal why, const Car& car, const Plan& plan, const world::Scene& scene) {
  const std::string policy(index(plan.policy) < num_policies ? name(plan.policy) : "");
  switch (why) {
    case Refusal::unknown_policy:
      return "no such policy";
    case Refusal::target_speed:
      return brakes_to_speed(plan.policy) == plan.target_speed.has_value()
                 ? with_number("target speed must be 0 to 25 m/s, is %.2f",
                               plan.target_speed.value_or(0.0))
                 : policy +
                       (plan.target_speed ? " takes no target speed" : " needs a target speed");
    case Refusal::grip:
      return scene.grip > 0.0
                 ? policy + with_number(" needs a grip of 0.2 to 1.0, is %.3f", scene.grip)
                 : with_number("grip must be > 0, is %.3f", scene.grip);
    case Refusal::ego_state:
      return "the ego's state is not finite";
    case Refusal::slippery:
      return policy + with_number(" is not possible at a grip of %.2f with this car", scene.grip);
    case Refusal::speed: {
      const SpeedRange range = speeds_of(car, plan, scene.grip);
      return policy + with_number(" needs a speed of %.4g", range.slowest) +
             with_number(" to %.4g m/s ahead", range.fastest) +
             with_number(", is %.2f", scene.ego.v_B.x);
    }
    case Refusal::road:
      return with_number("the road must be finite, its lane 2 to 6 m wide, is %.2f",
                         scene.road.lane_width);
    case Refusal::strength:
      return takes_strength(plan.policy)
                 ? with_number("strength must be 0.2 to 1, is %.3f", strength_of(plan))
                 : policy + " takes no strength";
    case Refusal::bend:
      if (share_of_bend(scene) <= most_share_of_bend(plan)) {
        return policy + with_number(" needs %.0f %% of the grip", 100.0 * least_share_of_swerve) +
               with_number(", this bend and speed leave %.0f %%",
                           100.0 * std::max(0.0, share_of_swerve(car, plan, scene)));
      }
      break;
  }
  return policy +
         with_number(" allows a bend %.0f %% of the grip", 100.0 * most_share_of_bend(plan)) +
         with_number(", this one takes %.0f %%", 100.0 * share_of_bend(scene));
}

}  // namespace

std::string_view name(Refusal why) {
  return name_of(why, refusal_names);
}

std::optional<Refusal> why_refused(const Car& car, const Plan& plan,
                                   const world::Scene& scene) noexcept {
  if (index(plan.policy) >= num_policies) {
    return Refusal::unknown_policy;
  }
  if (brakes_to_speed(plan.policy) != plan.target_speed.has_value() || !takes_target(plan)) {
    return Refusal::target_speed;
  }
  if (!has_right_strength(plan)) {
    return Refusal::strength;
  }
  const bool always = always_possible(plan.policy);
  if (!(scene.grip > 0.0) || (!always && !(scene.grip >= 0.2 && scene.grip <= 1.0))) {
    return Refusal::grip;
  }
  const world::EgoState& ego = scene.ego;
  if (!is_finite(ego.X_WB) || !is_finite(ego.v_B) || !std::isfinite(ego.yaw_rate) ||
      !is_finite(ego.a_B)) {
    return Refusal::ego_state;
  }
  const world::Road& road = scene.road;
  const bool finite_road = is_finite(road.X_WL) && std::isfinite(road.curvature);
  if (always) {
    return finite_road ? std::nullopt : std::optional(Refusal::road);
  }
  const SpeedRange range = speeds_of(car, plan, scene.grip);
  if (range.slowest > range.fastest) {
    return Refusal::slippery;
  }
  if (!(ego.v_B.x >= range.slowest && ego.v_B.x <= range.fastest)) {
    return Refusal::speed;
  }
  if (!finite_road || !(road.lane_width >= 2.0 && road.lane_width <= 6.0)) {
    return Refusal::road;
  }
  const bool has_grip = share_of_bend(scene) <= most_share_of_bend(plan) + 1e-9 &&
                        leaves_grip_to_swerve(car, plan, scene);
  return has_grip ? std::nullopt : std::optional(Refusal::bend);
}

std::optional<std::string> refusal(const Car& car, const Plan& plan, const world::Scene& scene) {
  const auto why = why_refused(car, plan, scene);
  return why ? std::optional(in_words(*why, car, plan, scene)) : std::nullopt;
}

EgoMotion drive(const Car& car, const Plan& plan, const world::Scene& scene, double grip,
                double horizon, const ParameterPerturbation& perturbation) {
  expects(grip > 0.0 && grip <= 1.2, "grip in (0, 1.2]");
  expects(horizon >= 0.0 && horizon <= 3600.0, "horizon in [0, 3600] s");
  Ride ride(car, plan, scene, grip, perturbation);
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

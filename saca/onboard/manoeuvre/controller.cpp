#include "saca/onboard/manoeuvre/controller.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/units.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/equations.h"

namespace saca::manoeuvre {
namespace {

using vehicle::Command;
using vehicle::gravity;
using vehicle::VehicleState;

// Numbers that hold for any car; those of a car are in its tuning.
constexpr double fast = 18.0;         // [m/s] above which yaw is damped too weakly for all grip
constexpr double keep_share = 0.3;    // of the grip, to take up a wrong direction in the lane
constexpr double least_ramp = 0.12;   // [s], steering and yaw cannot follow faster
constexpr double steering_use = 1.0;  // of the steering's rate, for the path's ramps
constexpr double most_heading = 0.5;  // [rad] against the lane during a lane change

using PathPoint = equations::PathPoint<double>;
using Wants = equations::Wants<double, bool>;

Wants wants(const Plan& plan) {
  return {.rest = plan.policy == PolicyId::aeb,
          .slower = brakes_to_speed(plan.policy),
          .strength = strength_of(plan)};
}

PathPoint path_point(const Car& car, const world::Road& road, const Pose& X_WB, Vec2 v_B,
                     double yaw_rate) {
  const double arm = equations::percussion_arm(car);
  const world::LanePose pose = world::to_lane(road, {X_WB * Vec2{arm, 0.0}, X_WB.yaw});
  return equations::path_point(pose.d, pose.heading, arm, v_B, yaw_rate);
}

double steering_for(const Car& car, double acceleration, double speed) {
  return std::atan((car.cg_to_front_axle + car.cg_to_rear_axle) * acceleration / (speed * speed));
}

// A lane change that the steering can follow: its angle, its rate, and the car's direction on the
// way stay within bounds at the lowest speed of the change.
LaneShift followable_shift(const Car& car, const PathPoint& start, double end_d, double share,
                           double grip, double slowest) {
  const double wheelbase = car.cg_to_front_axle + car.cg_to_rear_axle;
  const double turning = slowest * slowest * std::tan(0.8 * car.steering_limit) / wheelbase;
  double amplitude = std::min(share * grip * gravity, turning);
  LaneShift shift;
  for (int i = 0; i < 60; ++i) {
    const double slip =
        vehicle::slip_for(car.tyre, grip, std::min(1.0, amplitude / (grip * gravity)));
    const double angle = steering_for(car, amplitude, slowest) + slip;
    const double ramp = std::max(least_ramp, angle / (steering_use * car.steering_rate));
    shift = lane_shift(start.d, start.v_L.y, end_d, amplitude, ramp);
    const double sine = largest_rate(shift) / slowest;
    // Across the lane, the tyres' sideways force points partly backwards.
    const bool has_grip =
        amplitude <= share * grip * gravity * std::sqrt(std::max(0.0, 1.0 - sine * sine));
    if (sine <= std::sin(most_heading) && has_grip) {
      break;
    }
    amplitude *= 0.95;
  }
  return shift;
}

// Speed at the end of a braked lane change, roughly: what the circle leaves brakes for one second.
double slowest_speed(const Car& car, const Plan& plan, double speed, double grip) {
  if (!brakes_to_speed(plan.policy)) {
    return speed;
  }
  const double left_over = equations::deceleration_left(
      equations::combined_share, grip, car.tuning.swerve.braked_share * grip * gravity);
  return std::max({plan.target_speed.value_or(0.0), speed - left_over, 0.6 * speed});
}

Command drift(const Car& car, const world::Road& road, double grip, const VehicleState& state,
              double dt, ControllerState& memory) {
  const DriftMotion motion{world::to_lane(road, state.X_WB).heading, state.v_B, state.yaw_rate,
                           state.a_B};
  const auto law = side(memory.plan.policy) > 0 ? drift_left : drift_right;
  return law(car, car.tuning.drift, grip, motion, dt, memory.drift);
}

bool is_finite(const VehicleState& state, double grip) {
  return saca::is_finite(state.X_WB) && saca::is_finite(state.v_B) && saca::is_finite(state.a_B) &&
         std::isfinite(state.yaw_rate + state.steering + grip);
}

bool is_finite(const vehicle::PerWheel& values) {
  return std::all_of(values.begin(), values.end(), [](double one) { return std::isfinite(one); });
}
bool measures_wheels(const VehicleState& state) {
  return is_finite(state.wheel_speed) && is_finite(state.brake_torque) &&
         std::isfinite(state.motor_torque);
}

/// What is no number is taken for that of a wheel that rolls, without brake or motor.
VehicleState with_rolling_wheels(const Car& car, VehicleState state) {
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    if (!std::isfinite(state.wheel_speed[i])) {
      state.wheel_speed[i] = state.v_B.x / car.wheel_radius;
    }
    if (!std::isfinite(state.brake_torque[i])) {
      state.brake_torque[i] = 0.0;
    }
  }
  if (!std::isfinite(state.motor_torque)) {
    state.motor_torque = 0.0;
  }
  return state;
}

}  // namespace

double share_of_bend(const world::Scene& scene) noexcept {
  const double speed = scene.ego.v_B.x;
  return std::abs(scene.road.curvature) * speed * speed / (scene.grip * gravity);
}

double share_of_swerve(const Car& car, const Plan& plan, const world::Scene& scene) noexcept {
  const SwerveLaw& swerve = car.tuning.swerve;
  return (brakes_to_speed(plan.policy) ? swerve.braked_share : swerve.share) -
         swerve.fast_less * std::max(0.0, scene.ego.v_B.x - fast) - share_of_bend(scene);
}

ControllerState begin(const Car& car, const Plan& plan, const world::Scene& scene) {
  expects(!refusal(car, plan, scene).has_value(), "the plan can be driven: refusal(...)");
  const world::EgoState& ego = scene.ego;
  const PathPoint start = path_point(car, scene.road, ego.X_WB, ego.v_B, ego.yaw_rate);
  ControllerState memory;
  memory.plan = plan;
  memory.speed = ego.v_B.x;
  memory.abs = vehicle::begin_abs(ego.v_B.x);
  memory.drift.yaw_rate = side(plan.policy) * ego.yaw_rate;
  if (brakes_to_speed(plan.policy)) {
    memory.speed = std::min(memory.speed, *plan.target_speed);
  }
  if (changes_lane(plan.policy)) {
    memory.end_d = side(plan.policy) * scene.road.lane_width;
    memory.shift = followable_shift(car, start, memory.end_d, share_of_swerve(car, plan, scene),
                                    scene.grip, slowest_speed(car, plan, ego.v_B.x, scene.grip));
  } else {
    constexpr double coming_to = 0.5;  // [s] within which a wrong direction is taken up
    memory.end_d = start.d + coming_to * start.v_L.y;
    memory.shift = lane_shift(start.d, start.v_L.y, memory.end_d, keep_share * scene.grip * gravity,
                              least_ramp);
  }
  return memory;
}

namespace {

/// Of a state that is finite.
Command controlled(const Car& car, const world::Road& road, double grip, const VehicleState& state,
                   ControllerState& memory, double dt) {
  if (drifts(memory.plan.policy)) {
    memory.time += dt;
    return drift(car, road, grip, state, dt, memory);
  }
  const PathPoint point = path_point(car, road, state.X_WB, state.v_B, state.yaw_rate);
  const Command command = equations::follow_path<double, Command>(
      car, wants(memory.plan), equations::PathConditions<double>{road.curvature, grip, dt}, state,
      point, memory);
  memory.time += dt;
  return command;
}

}  // namespace

Command control(const Car& car, const world::Road& road, double grip, const VehicleState& state,
                ControllerState& memory, double dt) noexcept {
  if (!is_finite(state, grip)) {
    Command command;
    command.brake_torque.fill(car.brake_limit);
    return command;
  }
  return measures_wheels(state)
             ? controlled(car, road, grip, state, memory, dt)
             : controlled(car, road, grip, with_rolling_wheels(car, state), memory, dt);
}

bool ends_at_rest(const ControllerState& memory) noexcept {
  return drifts(memory.plan.policy) || equations::stops(wants(memory.plan), memory);
}

bool finished(const VehicleState& state, const ControllerState& memory) noexcept {
  const Plan& plan = memory.plan;
  constexpr double sure = 0.2;  // [s]
  if (plan.policy == PolicyId::no_intervention) {
    return false;
  }
  if (ends_at_rest(memory)) {
    return vehicle::at_rest(state);
  }
  return memory.recovered_for >= sure;
}

}  // namespace saca::manoeuvre

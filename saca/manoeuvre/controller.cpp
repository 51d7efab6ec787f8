#include "saca/manoeuvre/controller.h"

#include <algorithm>
#include <cmath>

#include "saca/core/units.h"
#include "saca/manoeuvre/drive.h"

namespace saca::manoeuvre {
namespace {

using vehicle::Command;
using vehicle::gravity;
using vehicle::VehicleState;

// Numbers that hold for any car; those of a car are in its tuning.
constexpr double fast = 18.0;            // [m/s] above which yaw is damped too weakly for all grip
constexpr double keep_share = 0.3;       // of the grip, to take up a wrong direction in the lane
constexpr double least_ramp = 0.12;      // [s], steering and yaw cannot follow faster
constexpr double steering_use = 1.0;     // of the steering's rate, for the path's ramps
constexpr double most_heading = 0.5;     // [rad] against the lane during a lane change
constexpr double front_limit = 0.97;     // share of the front tyres' peak that steering may ask for
constexpr double combined_share = 0.92;  // of the grip, for braking and steering together
constexpr double least_stop_share =
    0.6;                       // of the grip, that a stop brakes with whatever the path asks
constexpr double crawl = 1.5;  // [m/s] below it steering fades out

// Slower than this the car is not kept rolling but stopped [m/s].
constexpr double least_kept_speed = 0.5;

// How far ahead of the centre of mass rear forces do not accelerate the body sideways [m].
double percussion_arm(const Car& car) {
  return car.yaw_inertia / (car.mass * car.rear_arm);
}

// The controlled point against the lane.
struct PathPoint {
  double d;        // [m]
  double heading;  // of the car against the lane there [rad]
  Vec2 v_L;        // of the point [m/s]
};

PathPoint path_point(const Car& car, const world::Road& road, const Pose& X_WB, Vec2 v_B,
                     double yaw_rate) {
  const double arm = percussion_arm(car);
  const world::LanePose pose = world::to_lane(road, {X_WB * Vec2{arm, 0.0}, X_WB.yaw});
  return {pose.d, pose.heading, rotated({v_B.x, v_B.y + yaw_rate * arm}, pose.heading)};
}

double steering_for(const Car& car, double acceleration, double speed) {
  return std::atan((car.front_arm + car.rear_arm) * acceleration / (speed * speed));
}

// A lane change that the steering can follow: its angle, its rate, and the car's direction on the
// way stay within bounds at the lowest speed of the change.
LaneShift followable_shift(const Car& car, const PathPoint& start, double end_d, double share,
                           double grip, double slowest) {
  const double wheelbase = car.front_arm + car.rear_arm;
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

// Deceleration that the grip leaves beside a sideways acceleration [m/s^2].
double deceleration_left(double share, double grip, double sideways) {
  const double most = share * grip * gravity;
  return std::sqrt(std::max(0.0, most * most - sideways * sideways));
}

// Speed at the end of a braked lane change, roughly: what the circle leaves brakes for one second.
double slowest_speed(const Car& car, const Plan& plan, double speed, double grip) {
  if (!brakes_to_speed(plan.policy)) {
    return speed;
  }
  const double left_over =
      deceleration_left(combined_share, grip, car.tuning.swerve.braked_share * grip * gravity);
  return std::max({plan.target_speed.value_or(0.0), speed - left_over, 0.6 * speed});
}

// Acceleration that the path asks of the controlled point, to the left of the car [m/s^2].
double sideways_demand(const Car& car, const world::Road& road, const VehicleState& state,
                       const ControllerState& memory, const PathPoint& point) {
  // The steering follows late: its cause leads, and the path is expected as much later.
  const SwerveLaw& law = car.tuning.swerve;
  const double a = at(memory.shift, memory.time).a;
  const Lateral path = at(memory.shift, memory.time - law.lag);
  const double along_lane =
      a + 2.0 * law.damping * law.frequency * (path.v - point.v_L.y) +
      law.frequency * law.frequency * (path.d - point.d) +
      road.curvature * point.v_L.x * point.v_L.x / std::max(0.1, 1.0 - road.curvature * point.d);
  const double ahead = state.a_B.x - state.yaw_rate * state.yaw_rate * percussion_arm(car);
  const double cosine = std::max(0.3, std::cos(point.heading));
  return (along_lane - ahead * std::sin(point.heading)) / cosine;
}

// How much of the front tyres' force may push to either side, in [-1, 1].
struct Sides {
  double left;
  double right;
};

// The rear must keep grip: once it slips near its peak, the front may not turn the car further in,
// and past the peak it must turn it back.
Sides turning_allowed(const Car& car, const VehicleState& state, double grip) {
  const SwerveLaw& law = car.tuning.swerve;
  const double vy_rear = state.v_B.y - car.rear_arm * state.yaw_rate;
  const double slip = vy_rear / std::max(state.v_B.x, vehicle::slip_speed_floor);
  const double peak = vehicle::slip_for(car.tyre, grip, 1.0);
  const double excess = (std::abs(slip) / peak - law.guard_from) / law.guard_width;
  const double allowed = std::clamp(1.0 - excess, -0.5, 1.0);
  // A rear that slides to the right carries force to the left: the car turns left.
  return slip < 0.0 ? Sides{.left = allowed, .right = 1.0} : Sides{.left = 1.0, .right = allowed};
}

// Angle of the road wheels at which the front tyres push with the force that gives the demand.
double steering_angle(const Car& car, const VehicleState& state, double grip, double demand) {
  const double wheelbase = car.front_arm + car.rear_arm;
  const vehicle::PerWheel loads = vehicle::wheel_loads(car, {state.a_B.x, 0.0});
  const double load = loads[vehicle::front_left] + loads[vehicle::front_right];
  const double peak = vehicle::peak_friction(car.tyre, 0.5 * load, grip);
  const double most = front_limit * peak * load;
  const double braking = std::min(
      (state.brake_torque[vehicle::front_left] + state.brake_torque[vehicle::front_right]) /
          car.wheel_radius,
      0.98 * most);
  const double F_B = car.mass * car.rear_arm / wheelbase * demand;
  const double room = std::sqrt(most * most - braking * braking);
  const Sides allowed = turning_allowed(car, state, grip);
  const double F_T =
      std::clamp((F_B + braking * std::sin(state.steering)) / std::cos(state.steering),
                 -room * allowed.right, room * allowed.left);
  const double force = std::hypot(F_T, braking);
  if (force <= 0.0) {
    return std::atan2(state.v_B.y + car.front_arm * state.yaw_rate, state.v_B.x);
  }
  const double slip = vehicle::slip_for(car.tyre, peak, std::min(1.0, force / (peak * load)));
  const Vec2 v_axle_B{state.v_B.x, state.v_B.y + car.front_arm * state.yaw_rate};
  const double speed = norm(v_axle_B);
  const double sliding = slip * F_T / force * std::max(speed, vehicle::slip_speed_floor);
  return std::atan2(v_axle_B.y, v_axle_B.x) + std::asin(std::clamp(sliding / speed, -0.7, 0.7));
}

// What the driven axles together can take to the road, shared as the motor shares it [N].
double driven_load(const Car& car) {
  const double per_metre = car.mass * gravity / (car.front_arm + car.rear_arm);
  const double front_share = car.motor_front_share;
  const double by_front = per_metre * car.rear_arm / std::max(front_share, 1e-9);
  const double by_rear = per_metre * car.front_arm / std::max(1.0 - front_share, 1e-9);
  return std::min(by_front, by_rear);
}

double holding_torque(const Car& car, const VehicleState& state, double speed, double grip) {
  constexpr double gain = 2.0;           // [1/s]
  constexpr double driven_share = 0.25;  // of the driven axles' grip: the rest is for the path
  const double left_over = deceleration_left(1.0, grip, state.a_B.y) / (grip * gravity);
  const double most = driven_share * left_over * grip * driven_load(car);
  const double force = std::clamp(gain * car.mass * (speed - state.v_B.x), -most, most);
  return force * car.wheel_radius;
}

// Brakes or motor: what the plan wants of the speed, with what steering leaves.
void command_speed(const Car& car, const Plan& plan, double grip, const VehicleState& state,
                   double sideways, double dt, ControllerState& memory, Command& command) {
  const bool stops = plan.policy == PolicyId::aeb ||
                     (brakes_to_speed(plan.policy) && memory.speed < least_kept_speed);
  constexpr double approach = 0.25;  // [s]: the last of the braking fades within the brakes' delay
  double wanted = 0.0;
  if (stops) {
    // Where a bend needs all the grip, only less speed helps: a stop always brakes.
    const double share = plan.policy == PolicyId::aeb ? 1.0 : combined_share;
    wanted = std::max(deceleration_left(share, grip, sideways), least_stop_share * grip * gravity);
  } else if (brakes_to_speed(plan.policy) && state.v_B.x > memory.speed + 0.3) {
    wanted = std::min(deceleration_left(combined_share, grip, sideways),
                      (state.v_B.x - memory.speed) / approach);
  }
  if (wanted > 0.0 || stops) {
    command.brake_torque = vehicle::deployed_brakes(car, state, wanted, grip, dt, memory.abs);
    return;
  }
  memory.abs = vehicle::begin_abs(state.v_B.x);
  command.motor_torque = holding_torque(car, state, memory.speed, grip);
}

void watch_recovery(const Plan& plan, const PathPoint& point, const VehicleState& state, double dt,
                    const Car& car, ControllerState& memory) {
  constexpr double near_d = 0.2;      // [m]
  constexpr double near_speed = 1.0;  // [m/s]
  const double near_heading = from_degrees(2.0);
  const double d = point.d - percussion_arm(car) * std::sin(point.heading);
  const bool slow_enough = !brakes_to_speed(plan.policy) || state.v_B.x < memory.speed + near_speed;
  const bool recovered =
      std::abs(d - memory.end_d) < near_d && std::abs(point.heading) < near_heading && slow_enough;
  memory.recovered_for = recovered ? memory.recovered_for + dt : 0.0;
}

Command drift(const Car& car, const Plan& plan, const world::Road& road, double grip,
              const VehicleState& state, double dt, ControllerState& memory) {
  const DriftMotion motion{world::to_lane(road, state.X_WB).heading, state.v_B, state.yaw_rate,
                           state.a_B};
  const auto law = side(plan.policy) > 0 ? drift_left : drift_right;
  return law(car, car.tuning.drift, grip, motion, dt, memory.drift);
}

bool is_finite(const VehicleState& state, double grip) {
  return saca::is_finite(state.X_WB) && saca::is_finite(state.v_B) && saca::is_finite(state.a_B) &&
         std::isfinite(state.yaw_rate + state.steering + grip);
}

}  // namespace

ControllerState begin(const Car& car, const Plan& plan, const world::Scene& scene) {
  expects(!refusal(car, plan, scene).has_value(), "the plan can be driven: refusal(...)");
  const world::EgoState& ego = scene.ego;
  const PathPoint start = path_point(car, scene.road, ego.X_WB, ego.v_B, ego.yaw_rate);
  ControllerState memory;
  memory.speed = ego.v_B.x;
  memory.abs = vehicle::begin_abs(ego.v_B.x);
  memory.drift.yaw_rate = side(plan.policy) * ego.yaw_rate;
  if (brakes_to_speed(plan.policy)) {
    memory.speed = std::min(memory.speed, *plan.target_speed);
  }
  if (changes_lane(plan.policy)) {
    memory.end_d = side(plan.policy) * scene.road.lane_width;
    const double bend = std::abs(scene.road.curvature) * ego.v_B.x * ego.v_B.x;
    const double given_up = car.tuning.swerve.fast_less * std::max(0.0, ego.v_B.x - fast) +
                            bend / (scene.grip * gravity);
    const double share =
        (brakes_to_speed(plan.policy) ? car.tuning.swerve.braked_share : car.tuning.swerve.share) -
        given_up;
    memory.shift = followable_shift(car, start, memory.end_d, share, scene.grip,
                                    slowest_speed(car, plan, ego.v_B.x, scene.grip));
  } else {
    constexpr double coming_to = 0.5;  // [s] within which a wrong direction is taken up
    memory.end_d = start.d + coming_to * start.v_L.y;
    memory.shift = lane_shift(start.d, start.v_L.y, memory.end_d, keep_share * scene.grip * gravity,
                              least_ramp);
  }
  return memory;
}

Command control(const Car& car, const Plan& plan, const world::Road& road, double grip,
                const VehicleState& state, ControllerState& memory, double dt) noexcept {
  Command command;
  if (!is_finite(state, grip)) {
    command.brake_torque.fill(car.brake_limit);
    return command;
  }
  if (drifts(plan.policy)) {
    memory.time += dt;
    return drift(car, plan, road, grip, state, dt, memory);
  }
  const PathPoint point = path_point(car, road, state.X_WB, state.v_B, state.yaw_rate);
  const double demand = sideways_demand(car, road, state, memory, point);
  const double most = grip * gravity;
  const double sideways = std::min(std::max(std::abs(demand), std::abs(state.a_B.y)), most);
  const double speed = norm(state.v_B);
  if (speed > 0.0) {
    command.steering = steering_angle(car, state, grip, std::clamp(demand, -most, most)) *
                       std::min(1.0, speed / crawl);
  }
  command_speed(car, plan, grip, state, speed > crawl ? sideways : 0.0, dt, memory, command);
  watch_recovery(plan, point, state, dt, car, memory);
  memory.time += dt;
  return command;
}

bool finished(const Plan& plan, const VehicleState& state, const ControllerState& memory) noexcept {
  constexpr double sure = 0.2;  // [s]
  if (plan.policy == PolicyId::no_intervention) {
    return false;
  }
  if (plan.policy == PolicyId::aeb || drifts(plan.policy) ||
      (brakes_to_speed(plan.policy) && memory.speed < least_kept_speed)) {
    return vehicle::at_rest(state);
  }
  return memory.recovered_for >= sure;
}

}  // namespace saca::manoeuvre

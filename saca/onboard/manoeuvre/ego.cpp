#include "saca/onboard/manoeuvre/ego.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::manoeuvre {
namespace {

using vehicle::PerWheel;
using vehicle::Vehicle;
using vehicle::VehicleState;

constexpr double standing = 0.5;     // [m/s] below it neither steering nor pedals can be told
constexpr double most_share = 0.95;  // of a tyre's peak: what nobody drives at without control

// Angle at which the front tyres give their share of the turning that the ego does.
double steering_of(const Vehicle& car, const world::EgoState& ego, double grip) {
  const double wheelbase = car.cg_to_front_axle + car.cg_to_rear_axle;
  const double load = car.mass * vehicle::gravity * car.cg_to_rear_axle / wheelbase;
  const double peak = vehicle::peak_friction(car.tyre, 0.5 * load, grip);
  const double F = car.mass * car.cg_to_rear_axle / wheelbase * ego.v_B.x * ego.yaw_rate;
  const double share = std::min(most_share, std::abs(F) / (peak * load));
  const double slip = std::copysign(vehicle::slip_for(car.tyre, peak, share), F) *
                      std::max(1.0, vehicle::slip_speed_floor / ego.v_B.x);
  const double way = std::atan2(ego.v_B.y + car.cg_to_front_axle * ego.yaw_rate, ego.v_B.x);
  return std::clamp(way + std::asin(std::clamp(slip, -0.7, 0.7)), -car.steering_limit,
                    car.steering_limit);
}

// Force along its plane that each wheel gives, so that together they accelerate the car as the ego:
// braked by load, driven as the motor does [N].
PerWheel driving_forces(const Vehicle& car, double acceleration, const PerWheel& loads,
                        double grip) {
  const double force = car.mass * acceleration;
  const double total = loads[0] + loads[1] + loads[2] + loads[3];
  PerWheel forces{};
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    const double share = force < 0.0 ? loads[i] / total : vehicle::motor_share(car, i);
    const double most = most_share * vehicle::peak_friction(car.tyre, loads[i], grip) * loads[i];
    forces[i] = std::clamp(force * share, -most, most);
  }
  return forces;
}

}  // namespace

VehicleState rolling_state(const Vehicle& car, const world::EgoState& ego, double grip) {
  expects(is_finite(ego.X_WB) && is_finite(ego.v_B) && std::isfinite(ego.yaw_rate) &&
              is_finite(ego.a_B),
          "the ego's state is finite");
  expects(grip > 0.0 && grip <= 1.2, "grip in (0, 1.2]");
  VehicleState state;
  state.X_WB = {ego.X_WB.p, wrap_angle(ego.X_WB.yaw)};
  state.v_B = ego.v_B;
  state.yaw_rate = ego.yaw_rate;
  const bool moves = ego.v_B.x > standing;
  if (moves) {
    state.steering = steering_of(car, ego, grip);
    state.a_B = ego.a_B;
    state.transfer_a_B = ego.a_B;
  }
  const PerWheel loads = vehicle::wheel_loads(car, state.transfer_a_B);
  const PerWheel forces = driving_forces(car, state.a_B.x, loads, grip);
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    const Vec2 p_B = vehicle::wheel_position(car, i);
    const Vec2 v_B{ego.v_B.x - ego.yaw_rate * p_B.y, ego.v_B.y + ego.yaw_rate * p_B.x};
    const Vec2 v_T = p_B.x > 0.0 ? rotated(v_B, -state.steering) : v_B;
    const double peak = vehicle::peak_friction(car.tyre, loads[i], grip);
    const double share = loads[i] > 0.0 ? std::abs(forces[i]) / (peak * loads[i]) : 0.0;
    const double slip = std::copysign(vehicle::slip_for(car.tyre, peak, share), forces[i]);
    const double speed = std::max(norm(v_B), vehicle::slip_speed_floor);
    state.wheel_speed[i] = (v_T.x + slip * speed) / car.wheel_radius;
    const double inertia = p_B.x > 0.0 ? car.front_wheel_inertia : car.rear_wheel_inertia;
    const double torque = forces[i] * car.wheel_radius + inertia * state.a_B.x / car.wheel_radius;
    if (state.a_B.x < 0.0) {
      state.brake_torque[i] = std::clamp(-torque, 0.0, car.brake_limit);
    } else if (vehicle::motor_share(car, i) > 0.0) {
      state.motor_torque += torque;
    }
  }
  state.motor_torque = std::clamp(state.motor_torque, -car.motor_limit, car.motor_limit);
  state.brake_line.torque.fill(state.brake_torque);
  return state;
}

world::EgoState ego_state(const VehicleState& state) {
  return {.X_WB = state.X_WB, .v_B = state.v_B, .yaw_rate = state.yaw_rate, .a_B = state.a_B};
}

world::Footprint footprint(const Vehicle& car) {
  return {.shape = world::Shape::box,
          .length = car.body_length,
          .width = car.body_width,
          .centre_x = car.front_end - 0.5 * car.body_length};
}

}  // namespace saca::manoeuvre

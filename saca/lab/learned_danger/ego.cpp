#include "saca/lab/learned_danger/ego.h"

#include <cmath>
#include <numeric>

#include "saca/base/core/contract.h"

namespace saca::learned_danger {

double course(const Ego& ego) {
  const bool moves = norm(ego.v_B) > 0.0;
  return ego.X_WB.yaw + (moves ? std::atan2(ego.v_B.y, ego.v_B.x) : 0.0);
}

Ego ego_of(const vehicle::Vehicle& car, const vehicle::VehicleState& state) {
  const double per_torque = 1.0 / (car.wheel_radius * car.mass);
  const double brakes = std::accumulate(state.brake_torque.begin(), state.brake_torque.end(), 0.0);
  return {.X_WB = state.X_WB,
          .v_B = state.v_B,
          .yaw_rate = state.yaw_rate,
          .a_B = state.a_B,
          .steering = state.steering,
          .braking = per_torque * brakes,
          .driving = per_torque * state.motor_torque};
}

DemandDrivenCar::DemandDrivenCar(const manoeuvre::Car& car, const vehicle::VehicleState& state,
                                 double grip)
    : car_(&car), state_(state), grip_(grip), abs_(vehicle::begin_abs(state.v_B.x)) {
  expects(grip >= 0.2 && grip <= 1.0, "grip in [0.2, 1.0]");
}

PosesOnTheWay DemandDrivenCar::hold(const manoeuvre::Demand& demand) {
  constexpr double dt = vehicle::usual_step;
  const int steps = static_cast<int>(std::lround(look_step / dt / poses_per_look));
  const manoeuvre::Demand held = manoeuvre::admissible(demand);
  PosesOnTheWay poses;
  for (Pose& pose : poses) {
    for (int i = 0; i < steps; ++i) {
      const vehicle::Command command = manoeuvre::command_for(*car_, held, grip_, state_, abs_, dt);
      state_ = vehicle::step(*car_, state_, command, grip_, dt);
    }
    pose = state_.X_WB;
  }
  return poses;
}

}  // namespace saca::learned_danger

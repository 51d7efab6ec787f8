#include "saca/manoeuvre/drift.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace saca::manoeuvre {
namespace {

using vehicle::Command;
using vehicle::front_left;
using vehicle::front_right;
using vehicle::rear_left;
using vehicle::rear_right;
using vehicle::Vehicle;

// How much more turning is wanted, as a share of what the actuators can do, in [-1, 1].
double demand(const DriftLaw& law, double grip, const DriftMotion& motion,
              const DriftState& memory) {
  constexpr double least_speed = 1.0;  // [m/s]
  const double foreseen = motion.heading + law.lead * motion.yaw_rate;
  const double slowing = law.slide_share * grip * vehicle::gravity;
  const double wanted = law.turning * (0.5 * std::numbers::pi - foreseen) * slowing /
                        std::max(norm(motion.v_B), least_speed);
  const double missing = std::clamp(wanted, -law.most_turning, law.most_turning) - motion.yaw_rate -
                         law.lead * memory.yaw_acceleration;
  return std::clamp(law.gain * missing, -1.0, 1.0);
}

}  // namespace

Command drift_left(const Vehicle& car, const DriftLaw& law, double grip, const DriftMotion& motion,
                   double dt, DriftState& memory) noexcept {
  constexpr double smoothing = 0.02;    // [s]
  constexpr double over_brake = 1.6;    // of what a wheel can take: it locks
  constexpr double least_load = 500.0;  // [N] that a lifted wheel is braked for
  constexpr double slow = 2.0;          // [m/s]
  const double growth = (motion.yaw_rate - memory.yaw_rate) / dt;
  memory.yaw_acceleration += std::min(1.0, dt / smoothing) * (growth - memory.yaw_acceleration);
  memory.yaw_rate = motion.yaw_rate;

  Command command;
  if (norm(motion.v_B) < law.lock_speed) {
    command.brake_torque.fill(car.brake_limit);
    return command;
  }
  const double u = demand(law, grip, motion, memory);
  const double in = std::max(u, 0.0);
  const double out = std::max(-u, 0.0);
  const double course =
      std::atan2(motion.v_B.y + car.front_arm * motion.yaw_rate, std::max(motion.v_B.x, 0.1));
  command.steering = std::clamp(course + law.steering * u, -car.steering_limit, car.steering_limit);
  const double front = 1.0 - law.front_release * in;
  const double rear = 1.0 - law.rear_release * out;
  const double left = 1.0 - law.outer_release * out;
  const double right = 1.0 - law.outer_release * in;
  const vehicle::PerWheel share{front * left, front * right, rear * left, rear * right};
  const vehicle::PerWheel loads = vehicle::wheel_loads(car, motion.a_B);
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    command.brake_torque[i] =
        over_brake * share[i] * grip * std::max(loads[i], least_load) * car.wheel_radius;
  }
  const double weight = car.mass * vehicle::gravity;
  const double torque =
      law.motor_share * in * std::min(car.motor_limit, grip * weight * car.wheel_radius);
  // The motor may turn a slow car, but not drive it off: it would never rest.
  const bool drives_off = norm(motion.v_B) < slow && torque * motion.v_B.x > 0.0;
  command.motor_torque = drives_off ? 0.0 : torque;
  return command;
}

Command drift_right(const Vehicle& car, const DriftLaw& law, double grip, const DriftMotion& motion,
                    double dt, DriftState& memory) noexcept {
  const DriftMotion mirrored{-motion.heading,
                             {motion.v_B.x, -motion.v_B.y},
                             -motion.yaw_rate,
                             {motion.a_B.x, -motion.a_B.y}};
  Command command = drift_left(car, law, grip, mirrored, dt, memory);
  command.steering = -command.steering;
  std::swap(command.brake_torque[front_left], command.brake_torque[front_right]);
  std::swap(command.brake_torque[rear_left], command.brake_torque[rear_right]);
  return command;
}

}  // namespace saca::manoeuvre

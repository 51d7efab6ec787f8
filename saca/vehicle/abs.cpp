#include "saca/vehicle/abs.h"

#include <algorithm>
#include <cmath>

namespace saca::vehicle {
namespace {

// Brakes follow commands 0.1 s late, and a braking car's rear wheels unload: each wheel gets what
// it can take both now and once the load has moved.
PerWheel lasting_loads(const Vehicle& car, Vec2 a_now_B, double deceleration) {
  PerWheel now = wheel_loads(car, a_now_B);
  const PerWheel then = wheel_loads(car, {-deceleration, a_now_B.y});
  for (std::size_t i = 0; i < num_wheels; ++i) {
    now[i] = std::min(now[i], then[i]);
  }
  return now;
}

// What all four tyres give at their peaks, once the load has moved for full grip [m/s^2].
double lasting_deceleration(const Vehicle& car, double grip) {
  const PerWheel loads = wheel_loads(car, {-grip * gravity, 0.0});
  double force = 0.0;
  for (const double load : loads) {
    force += peak_friction(car.tyre, load, grip) * load;
  }
  return force / car.mass;
}

// Part of the brake torque that slows the wheel itself and never reaches the road [N m].
double slowing_torque(const Vehicle& car, std::size_t wheel, double deceleration) {
  const double inertia = wheel < rear_left ? car.front_wheel_inertia : car.rear_wheel_inertia;
  return inertia * deceleration / car.wheel_radius;
}

// The estimate of the speed ahead, `dt` on: acceleration integrated; while nothing brakes or drives
// the wheels of the axle with less of the motor, they roll and tell the speed itself.
double followed_speed(const Vehicle& car, const VehicleState& state, double dt, double speed) {
  constexpr double trust = 0.01;    // [s] within which rolling wheels are believed
  constexpr double rolling = 20.0;  // [N m]: of both: hardly any slip
  const bool front = car.motor_front_share <= 0.5;
  const std::size_t left = front ? front_left : rear_left;
  const std::size_t right = front ? front_right : rear_right;
  const double turning = state.brake_torque[left] + state.brake_torque[right] +
                         2.0 * motor_share(car, left) * std::abs(state.motor_torque);
  double followed = speed + dt * (state.a_B.x + state.yaw_rate * state.v_B.y);
  if (turning < rolling) {
    const double wheels = 0.5 * (state.wheel_speed[left] + state.wheel_speed[right]) *
                          car.wheel_radius * (front ? std::cos(state.steering) : 1.0);
    followed += std::min(1.0, dt / trust) * (wheels - followed);
  }
  return std::max(0.0, followed);
}

// Slip of each wheel along its own plane, against a speed that does not come from the wheels.
PerWheel estimated_slip(const Vehicle& car, const VehicleState& state, double speed) {
  PerWheel slip{};
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const Vec2 p_B = wheel_position(car, i);
    const Vec2 v_B{speed - state.yaw_rate * p_B.y, state.v_B.y + state.yaw_rate * p_B.x};
    const double angle = p_B.x > 0.0 ? state.steering : 0.0;
    const double ahead = std::cos(angle) * v_B.x + std::sin(angle) * v_B.y;
    slip[i] = (ahead - car.wheel_radius * state.wheel_speed[i]) / std::max(ahead, slip_speed_floor);
  }
  return slip;
}

}  // namespace

PerWheel ideal_brakes(const Vehicle& car, const VehicleState& state, double grip) noexcept {
  constexpr double margin = 0.99;  // the peak itself is the edge of locking
  const double deceleration = lasting_deceleration(car, grip);
  const PerWheel loads = lasting_loads(car, state.transfer_a_B, deceleration);
  PerWheel torque{};
  for (std::size_t i = 0; i < num_wheels; ++i) {
    torque[i] = margin * peak_friction(car.tyre, loads[i], grip) * loads[i] * car.wheel_radius +
                slowing_torque(car, i, deceleration);
  }
  return torque;
}

AbsState begin_abs(double speed) noexcept {
  return {.speed = speed};
}

PerWheel deployed_brakes(const Vehicle& car, const VehicleState& state, double deceleration,
                         double grip, double dt, AbsState& abs) noexcept {
  // Gains found by simulation over 5 to 25 m/s and grip 0.3 to 1.0 with the estimate wrong by up to
  // 20 %; they have no other source.
  constexpr double model_share = 0.95;      // of the estimated peak: where the controller starts
  constexpr double wanted_dry_slip = 0.10;  // at grip 1: 96 % of the peak force, on its safe side
  constexpr double lead = 0.06;             // [s] by which slip is foreseen, for the brakes' delay
  constexpr double raise = 0.5;             // [1/s] share won back at no slip
  constexpr double lower = 4.0;             // [1/s] share given up at twice the wanted slip
  constexpr double release = 0.35;          // share released at once at twice the wanted slip
  constexpr double least_speed = 1.0;       // [m/s] below it slip means nothing and wheels may lock

  abs.speed = followed_speed(car, state, dt, abs.speed);
  const PerWheel slips = estimated_slip(car, state, abs.speed);
  const double most = grip * gravity;
  const PerWheel loads = lasting_loads(car, state.a_B, std::min(deceleration, most));
  const double wanted_slip = wanted_dry_slip * grip;
  const double wanted = std::min(deceleration / most, model_share);
  const bool all_wanted = deceleration >= model_share * most;

  PerWheel torque{};
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double growth = std::clamp((slips[i] - abs.slip[i]) / dt, -20.0, 20.0);
    abs.slip[i] = slips[i];
    const double foreseen = slips[i] + lead * growth;
    const double excess = std::clamp(foreseen / wanted_slip - 1.0, -1.0, 2.0);
    // Little slip means unused grip only where all of it is wanted; else the model's torque will
    // do.
    const double rest = all_wanted ? -raise * excess : raise * (1.0 - abs.share[i]);
    const double learning = excess > 0.0 ? -lower * excess : rest;
    abs.share[i] = std::clamp(abs.share[i] + dt * learning, 0.2, 1.4);
    const double now =
        abs.speed < least_speed ? 1.0 : abs.share[i] - release * std::max(0.0, excess);
    const double full =
        wanted * (grip * loads[i] * car.wheel_radius + slowing_torque(car, i, most));
    torque[i] = std::max(0.0, now) * full;
  }
  return torque;
}

}  // namespace saca::vehicle

#include "saca/onboard/vehicle/vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/onboard/vehicle/equations.h"

namespace saca::vehicle {
namespace {

using equations::actuator_rates;
using equations::body_rates;
using equations::is_front;
using equations::turn_by;
using equations::wheel_inertia;
using equations::wheels_of;
using StateVector = equations::StateVector<double>;
using Turn = equations::Turn<double>;
using Wheels = equations::Wheels<double>;

StateVector along(const StateVector& start, double dt, const StateVector& rate) {
  StateVector end = start;
  for (std::size_t i = 0; i < StateVector::size; ++i) {
    end[i] += dt * rate[i];
  }
  return end;
}

StateVector state_vector_of(const VehicleState& state) {
  StateVector state_vector;
  state_vector[StateVector::x] = state.X_WB.p.x;
  state_vector[StateVector::y] = state.X_WB.p.y;
  state_vector[StateVector::yaw] = state.X_WB.yaw;
  state_vector[StateVector::vx] = state.v_B.x;
  state_vector[StateVector::vy] = state.v_B.y;
  state_vector[StateVector::yaw_rate] = state.yaw_rate;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    state_vector[StateVector::wheel + i] = state.wheel_speed[i];
    state_vector[StateVector::brake + i] = state.brake_torque[i];
  }
  state_vector[StateVector::steering] = state.steering;
  state_vector[StateVector::motor] = state.motor_torque;
  state_vector[StateVector::ax] = state.transfer_a_B.x;
  state_vector[StateVector::ay] = state.transfer_a_B.y;
  return state_vector;
}

void put(const StateVector& state_vector, VehicleState& state) {
  state.X_WB = {{state_vector[StateVector::x], state_vector[StateVector::y]},
                state_vector[StateVector::yaw]};
  state.v_B = {state_vector[StateVector::vx], state_vector[StateVector::vy]};
  state.yaw_rate = state_vector[StateVector::yaw_rate];
  for (std::size_t i = 0; i < num_wheels; ++i) {
    state.wheel_speed[i] = state_vector[StateVector::wheel + i];
    state.brake_torque[i] = state_vector[StateVector::brake + i];
  }
  state.steering = state_vector[StateVector::steering];
  state.motor_torque = state_vector[StateVector::motor];
  state.transfer_a_B = {state_vector[StateVector::ax], state_vector[StateVector::ay]};
}

Turn after(Turn first, Turn second) {
  return {first.cosine * second.cosine - first.sine * second.sine,
          first.sine * second.cosine + first.cosine * second.sine};
}

// `start` turned by a little more, without a call: exact to the last digit up to 0.05 rad, which is
// more than turns in a step.
inline Turn turned(Turn start, double angle) {
  if (std::abs(angle) > 0.05) [[unlikely]] {
    return after(start, turn_by(angle));
  }
  const double a = angle * angle;
  return after(start, {1.0 - a * (1.0 / 2.0 - a * (1.0 / 24.0 - a * (1.0 / 720.0))),
                       angle * (1.0 - a * (1.0 / 6.0 - a * (1.0 / 120.0 - a * (1.0 / 5040.0))))});
}

// What does not change within a step.
struct StepConstants {
  Command command;  // limited, the brakes' part delayed
  PerWheel grip;
  Turn heading;   // at the step's start, with its yaw
  double yaw;     // [rad]
  Turn steering;  // likewise
  double steering_angle;
  PerWheel rolls{1, 1, 1, 1};  // 0 for a locked wheel
  bool at_rest = false;
};

StepConstants held_from(const StateVector& start, const Command& command, const PerWheel& grip) {
  return {.command = command,
          .grip = grip,
          .heading = turn_by(start[StateVector::yaw]),
          .yaw = start[StateVector::yaw],
          .steering = turn_by(start[StateVector::steering]),
          .steering_angle = start[StateVector::steering]};
}

Wheels wheels_of(const Vehicle& car, const StateVector& state_vector, const StepConstants& held) {
  const Turn middle =
      turned(held.steering, state_vector[StateVector::steering] - held.steering_angle);
  return wheels_of(car, state_vector, middle, held.grip);
}

StateVector rates(const Vehicle& car, const StateVector& state_vector, const StepConstants& held) {
  StateVector rate;
  actuator_rates(car, state_vector, held.command, rate);
  equations::Pair<double> force;
  if (!held.at_rest) {
    const Wheels wheels = wheels_of(car, state_vector, held);
    equations::wheel_rates(car, state_vector, wheels, held.rolls, rate);
    const Turn heading = turned(held.heading, state_vector[StateVector::yaw] - held.yaw);
    force = body_rates(car, state_vector, wheels, heading, rate);
  }
  equations::load_rates(car, state_vector, force, rate);
  return rate;
}

bool is_finite(const Vehicle& car, const VehicleState& state, const Command& command) {
  double sum = state.X_WB.p.x + state.X_WB.p.y + state.X_WB.yaw + state.v_B.x + state.v_B.y +
               state.yaw_rate + state.steering + state.motor_torque + state.transfer_a_B.x +
               state.transfer_a_B.y + command.steering + command.motor_torque + car.mass;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    sum += state.wheel_speed[i] + state.brake_torque[i] + command.brake_torque[i];
  }
  return std::isfinite(sum);  // one NaN or infinity makes the sum one
}

bool in_range(const PerWheel& grip) {
  return std::all_of(grip.begin(), grip.end(),
                     [](double value) { return value > 0.0 && value <= 1.2; });
}

PerWheel after_dead_time(const Vehicle& car, const PerWheel& commanded, BrakeLine& line) {
  while (line.since >= BrakeLine::slot - 1e-9) {
    line.torque[line.next] = commanded;
    line.next = static_cast<std::uint8_t>((line.next + 1) % BrakeLine::num_slots);
    line.since -= BrakeLine::slot;
  }
  const auto delay = static_cast<std::size_t>(std::lround(car.brake_dead_time / BrakeLine::slot));
  return line.torque[(line.next + 2 * BrakeLine::num_slots - 1 - delay) % BrakeLine::num_slots];
}

void stop_all(VehicleState& state) {
  state.v_B = {};
  state.yaw_rate = 0.0;
  state.wheel_speed = {};
}

// A wheel that its brake would stop within 1 ms, and whose brake holds more than the road and the
// motor turn, is locked.
void lock_wheels(const Vehicle& car, StateVector& state_vector, StepConstants& held) {
  PerWheel locked{};
  bool any = false;
  StateVector stopped = state_vector;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double brake = state_vector[StateVector::brake + i];
    const double holds = std::abs(state_vector[StateVector::wheel + i]) * wheel_inertia(car, i);
    if (brake > 0.0 && holds * equations::brake_stiffness <= brake) {
      locked[i] = 1.0;
      stopped[StateVector::wheel + i] = 0.0;
      any = true;
    }
  }
  if (!any) {
    return;
  }
  const Wheels wheels = wheels_of(car, stopped, held);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double turning =
        equations::turning_torque(car, i, state_vector[StateVector::motor], wheels.F_x[i]);
    if (locked[i] > 0.0 && std::abs(turning) < state_vector[StateVector::brake + i]) {
      state_vector[StateVector::wheel + i] = 0.0;
      held.rolls[i] = 0.0;
    }
  }
}

Vec2 acceleration(const StateVector& state_vector, const StateVector& rate) {
  return {
      rate[StateVector::vx] - state_vector[StateVector::yaw_rate] * state_vector[StateVector::vy],
      rate[StateVector::vy] + state_vector[StateVector::yaw_rate] * state_vector[StateVector::vx]};
}

}  // namespace

Vec2 wheel_position(const Vehicle& car, std::size_t wheel) {
  return {is_front(wheel) ? car.cg_to_front_axle : -car.cg_to_rear_axle,
          equations::is_left(wheel) ? 0.5 * car.track_width : -0.5 * car.track_width};
}

double motor_share(const Vehicle& car, std::size_t wheel) {
  return 0.5 * (is_front(wheel) ? car.motor_front_share : 1.0 - car.motor_front_share);
}

PerWheel wheel_loads(const Vehicle& car, Vec2 a_B) {
  return equations::wheel_loads(car, a_B.x, a_B.y);
}

WheelContacts contacts(const Vehicle& car, const VehicleState& state, const PerWheel& grip) {
  expects(in_range(grip), "grip in (0, 1.2]");
  const StateVector state_vector = state_vector_of(state);
  const Wheels wheels = wheels_of(car, state_vector, held_from(state_vector, {}, grip));
  WheelContacts all;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double slip_x = wheels.v_x[i] - car.wheel_radius * state.wheel_speed[i];
    const double speed = std::hypot(wheels.v_x[i], wheels.v_y[i]);
    all[i] = {.load = wheels.load[i],
              .angle = std::atan2(wheels.sine[i], wheels.cosine[i]),
              .F_T = {wheels.F_x[i], wheels.F_y[i]},
              .slip = std::hypot(slip_x, wheels.v_y[i]) / std::max(speed, slip_speed_floor),
              .peak_force = peak_friction(car.tyre, wheels.load[i], grip[i]) * wheels.load[i]};
  }
  return all;
}

WheelContacts contacts(const Vehicle& car, const VehicleState& state, double grip) {
  return contacts(car, state, PerWheel{grip, grip, grip, grip});
}

double kinetic_energy(const Vehicle& car, const VehicleState& state) {
  double twice =
      car.mass * dot(state.v_B, state.v_B) + car.yaw_inertia * state.yaw_rate * state.yaw_rate;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    twice += wheel_inertia(car, i) * state.wheel_speed[i] * state.wheel_speed[i];
  }
  return 0.5 * twice;
}

bool at_rest(const VehicleState& state) {
  return state.v_B.x == 0.0 && state.v_B.y == 0.0 && state.yaw_rate == 0.0 &&
         std::all_of(state.wheel_speed.begin(), state.wheel_speed.end(),
                     [](double speed) { return speed == 0.0; });
}

double longest_step(const Vehicle& car) {
  // The fastest motion is the spin of a wheel that rolls slowly under its load, at the rate
  // R^2 stiffness load / (inertia floor). Wheels that slide are slower: their curve is flat.
  constexpr double more_load = 1.15;  // than at rest, for what turning moves at little slip
  constexpr double stable = 2.78;     // of the classical Runge-Kutta scheme, on the real axis
  double longest = 2e-3;
  const PerWheel loads = wheel_loads(car, {});
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double rate = car.wheel_radius * car.wheel_radius * car.tyre.stiffness * more_load *
                        loads[i] / (wheel_inertia(car, i) * slip_speed_floor);
    longest = std::min(longest, stable / rate);
  }
  return longest;
}

VehicleState step(const Vehicle& car, const VehicleState& state, const Command& command,
                  const PerWheel& grip, double dt) {
  expects(dt > 0.0 && dt <= longest_step(car), "dt in (0, longest_step(car)] s");
  expects(in_range(grip), "grip in (0, 1.2]");
  expects(is_finite(car, state, command), "car, state and command are finite");
  expects(std::all_of(command.brake_torque.begin(), command.brake_torque.end(),
                      [](double torque) { return torque >= 0.0; }),
          "brake_torque >= 0");

  VehicleState next = state;
  Command limited = command;
  limited.steering = std::clamp(command.steering, -car.steering_limit, car.steering_limit);
  limited.motor_torque = std::clamp(command.motor_torque, -car.motor_limit, car.motor_limit);
  limited.brake_torque = after_dead_time(car, command.brake_torque, next.brake_line);
  for (double& torque : limited.brake_torque) {
    torque = std::min(torque, car.brake_limit);
  }
  const bool holds = equations::is_held(car, state_vector_of(next));
  if (holds) {
    stop_all(next);
  }
  StateVector start = state_vector_of(next);
  StepConstants held = held_from(start, limited, grip);
  held.at_rest = holds;
  if (!holds) {
    lock_wheels(car, start, held);
  }
  const StateVector k1 = rates(car, start, held);
  const StateVector k2 = rates(car, along(start, 0.5 * dt, k1), held);
  const StateVector k3 = rates(car, along(start, 0.5 * dt, k2), held);
  const StateVector k4 = rates(car, along(start, dt, k3), held);
  StateVector end = start;
  for (std::size_t i = 0; i < StateVector::size; ++i) {
    end[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  put(end, next);
  next.X_WB.yaw = wrap_angle(next.X_WB.yaw);
  next.a_B = acceleration(start, k1);
  next.brake_line.since += dt;
  return next;
}

VehicleState step(const Vehicle& car, const VehicleState& state, const Command& command,
                  double grip, double dt) {
  return step(car, state, command, PerWheel{grip, grip, grip, grip}, dt);
}

}  // namespace saca::vehicle

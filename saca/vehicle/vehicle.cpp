#include "saca/vehicle/vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/core/contract.h"

namespace saca::vehicle {
namespace {

// A brake turns from full torque to none over the speed that it would take away in 1 / this.
constexpr double brake_stiffness = 1000.0;  // [1/s]

// What the integrator sees of a state: everything that has a rate.
struct Flow {
  enum : std::size_t {
    x,
    y,
    yaw,
    vx,
    vy,
    yaw_rate,
    wheel,
    steering = wheel + 4,
    brake,
    motor = brake + 4,
    ax,
    ay,
    size
  };
  std::array<double, size> value{};

  double& operator[](std::size_t i) { return value[i]; }
  double operator[](std::size_t i) const { return value[i]; }
};

Flow along(const Flow& start, double dt, const Flow& rate) {
  Flow end = start;
  for (std::size_t i = 0; i < Flow::size; ++i) {
    end[i] += dt * rate[i];
  }
  return end;
}

Flow flow_of(const VehicleState& state) {
  Flow flow;
  flow[Flow::x] = state.X_WB.p.x;
  flow[Flow::y] = state.X_WB.p.y;
  flow[Flow::yaw] = state.X_WB.yaw;
  flow[Flow::vx] = state.v_B.x;
  flow[Flow::vy] = state.v_B.y;
  flow[Flow::yaw_rate] = state.yaw_rate;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    flow[Flow::wheel + i] = state.wheel_speed[i];
    flow[Flow::brake + i] = state.brake_torque[i];
  }
  flow[Flow::steering] = state.steering;
  flow[Flow::motor] = state.motor_torque;
  flow[Flow::ax] = state.transfer_a_B.x;
  flow[Flow::ay] = state.transfer_a_B.y;
  return flow;
}

void put(const Flow& flow, VehicleState& state) {
  state.X_WB = {{flow[Flow::x], flow[Flow::y]}, flow[Flow::yaw]};
  state.v_B = {flow[Flow::vx], flow[Flow::vy]};
  state.yaw_rate = flow[Flow::yaw_rate];
  for (std::size_t i = 0; i < num_wheels; ++i) {
    state.wheel_speed[i] = flow[Flow::wheel + i];
    state.brake_torque[i] = flow[Flow::brake + i];
  }
  state.steering = flow[Flow::steering];
  state.motor_torque = flow[Flow::motor];
  state.transfer_a_B = {flow[Flow::ax], flow[Flow::ay]};
}

// A turn, as its cosine and sine.
struct Turn {
  double cosine = 1.0;
  double sine = 0.0;
};

Turn turn_by(double angle) {
  return {std::cos(angle), std::sin(angle)};
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
struct Held {
  Command command;  // limited, the brakes' part delayed
  PerWheel grip;
  Turn heading;   // at the step's start, with its yaw
  double yaw;     // [rad]
  Turn steering;  // likewise
  double steering_angle;
  PerWheel rolls{1, 1, 1, 1};  // 0 for a locked wheel
  bool at_rest = false;
};

Held held_from(const Flow& start, const Command& command, const PerWheel& grip) {
  return {.command = command,
          .grip = grip,
          .heading = turn_by(start[Flow::yaw]),
          .yaw = start[Flow::yaw],
          .steering = turn_by(start[Flow::steering]),
          .steering_angle = start[Flow::steering]};
}

bool is_front(std::size_t wheel) {
  return wheel == front_left || wheel == front_right;
}

double wheel_inertia(const Vehicle& car, std::size_t wheel) {
  return is_front(wheel) ? car.front_wheel_inertia : car.rear_wheel_inertia;
}

// Everything about the four contacts; arrays, so that the compiler can work on several at once.
struct Wheels {
  PerWheel cosine, sine;  // of the wheels' angles against the body
  PerWheel v_x, v_y;      // of the wheel centres, expressed in T [m/s]
  PerWheel load;          // [N]
  PerWheel F_x, F_y;      // expressed in T [N]
};

Wheels wheels_of(const Vehicle& car, const Flow& flow, const Held& held) {
  Wheels wheels;
  wheels.load = wheel_loads(car, {flow[Flow::ax], flow[Flow::ay]});
  const Turn middle = turned(held.steering, flow[Flow::steering] - held.steering_angle);
  // Ackermann: the axes of the front wheels meet on the rear axle's line, so the inner one turns
  // more.
  const double wheelbase = car.front_arm + car.rear_arm;
  const double half_track = 0.5 * car.track_width;
  const PerWheel x{car.front_arm, car.front_arm, -car.rear_arm, -car.rear_arm};
  const PerWheel y{half_track, -half_track, half_track, -half_track};
  wheels.cosine = {1.0, 1.0, 1.0, 1.0};
  wheels.sine = {};
  for (const std::size_t i : {front_left, front_right}) {
    const double along = wheelbase * middle.cosine - y[i] * middle.sine;
    const double across = wheelbase * middle.sine;
    const double scale = 1.0 / std::sqrt(along * along + across * across);
    wheels.cosine[i] = along * scale;
    wheels.sine[i] = across * scale;
  }
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double v_x = flow[Flow::vx] - flow[Flow::yaw_rate] * y[i];
    const double v_y = flow[Flow::vy] + flow[Flow::yaw_rate] * x[i];
    wheels.v_x[i] = wheels.cosine[i] * v_x + wheels.sine[i] * v_y;
    wheels.v_y[i] = wheels.cosine[i] * v_y - wheels.sine[i] * v_x;
    const double slip_x = wheels.v_x[i] - car.wheel_radius * flow[Flow::wheel + i];
    const double drag = sliding_drag(car.tyre, slip_x * slip_x + wheels.v_y[i] * wheels.v_y[i],
                                     v_x * v_x + v_y * v_y, wheels.load[i], held.grip[i]);
    wheels.F_x[i] = -drag * slip_x;
    wheels.F_y[i] = -drag * wheels.v_y[i];
  }
  return wheels;
}

void actuator_rates(const Vehicle& car, const Flow& flow, const Held& held, Flow& rate) {
  rate[Flow::steering] =
      std::clamp((held.command.steering - flow[Flow::steering]) / car.steering_lag,
                 -car.steering_rate, car.steering_rate);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    rate[Flow::brake + i] = (held.command.brake_torque[i] - flow[Flow::brake + i]) / car.brake_lag;
  }
  rate[Flow::motor] = (held.command.motor_torque - flow[Flow::motor]) / car.motor_lag;
}

Flow rates(const Vehicle& car, const Flow& flow, const Held& held) {
  Flow rate;
  actuator_rates(car, flow, held, rate);
  Vec2 F_B;
  double torque = 0.0;
  if (!held.at_rest) {
    const Wheels wheels = wheels_of(car, flow, held);
    for (std::size_t i = 0; i < num_wheels; ++i) {
      const Vec2 F_wheel_B{wheels.cosine[i] * wheels.F_x[i] - wheels.sine[i] * wheels.F_y[i],
                           wheels.sine[i] * wheels.F_x[i] + wheels.cosine[i] * wheels.F_y[i]};
      const Vec2 p_B = wheel_position(car, i);
      F_B = F_B + F_wheel_B;
      torque += p_B.x * F_wheel_B.y - p_B.y * F_wheel_B.x;
      const double inertia = wheel_inertia(car, i);
      const double brake = std::clamp(brake_stiffness * inertia * flow[Flow::wheel + i],
                                      -flow[Flow::brake + i], flow[Flow::brake + i]);
      rate[Flow::wheel + i] =
          held.rolls[i] *
          (motor_share(car, i) * flow[Flow::motor] - brake - car.wheel_radius * wheels.F_x[i]) /
          inertia;
    }
    const Vec2 v_B{flow[Flow::vx], flow[Flow::vy]};
    F_B = F_B - (0.5 * air_density * car.drag_area * std::sqrt(dot(v_B, v_B))) * v_B;
    const Turn heading = turned(held.heading, flow[Flow::yaw] - held.yaw);
    rate[Flow::x] = heading.cosine * v_B.x - heading.sine * v_B.y;
    rate[Flow::y] = heading.sine * v_B.x + heading.cosine * v_B.y;
    rate[Flow::yaw] = flow[Flow::yaw_rate];
    rate[Flow::vx] = F_B.x / car.mass + flow[Flow::yaw_rate] * v_B.y;
    rate[Flow::vy] = F_B.y / car.mass - flow[Flow::yaw_rate] * v_B.x;
    rate[Flow::yaw_rate] = torque / car.yaw_inertia;
  }
  rate[Flow::ax] = (F_B.x / car.mass - flow[Flow::ax]) / car.load_transfer_lag;
  rate[Flow::ay] = (F_B.y / car.mass - flow[Flow::ay]) / car.load_transfer_lag;
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

// The brakes hold a slow car when they can take more than its motor gives.
bool is_held(const Vehicle& car, const VehicleState& state) {
  const double brakes =
      state.brake_torque[0] + state.brake_torque[1] + state.brake_torque[2] + state.brake_torque[3];
  constexpr double least = 50.0;  // [N m]: brakes that merely linger do not hold
  const double arm = car.front_arm + car.rear_arm;
  return norm(state.v_B) < hold_speed && std::abs(state.yaw_rate) * arm < hold_speed &&
         brakes > std::abs(state.motor_torque) + least;
}

void stop_all(VehicleState& state) {
  state.v_B = {};
  state.yaw_rate = 0.0;
  state.wheel_speed = {};
}

// A wheel that its brake would stop within 1 ms, and whose brake holds more than the road and the
// motor turn, is locked.
void lock_wheels(const Vehicle& car, Flow& flow, Held& held) {
  PerWheel locked{};
  bool any = false;
  Flow stopped = flow;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double brake = flow[Flow::brake + i];
    if (brake > 0.0 &&
        std::abs(flow[Flow::wheel + i]) * wheel_inertia(car, i) * brake_stiffness <= brake) {
      locked[i] = 1.0;
      stopped[Flow::wheel + i] = 0.0;
      any = true;
    }
  }
  if (!any) {
    return;
  }
  const Wheels wheels = wheels_of(car, stopped, held);
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double turning =
        motor_share(car, i) * flow[Flow::motor] - car.wheel_radius * wheels.F_x[i];
    if (locked[i] > 0.0 && std::abs(turning) < flow[Flow::brake + i]) {
      flow[Flow::wheel + i] = 0.0;
      held.rolls[i] = 0.0;
    }
  }
}

Vec2 acceleration(const Flow& flow, const Flow& rate) {
  return {rate[Flow::vx] - flow[Flow::yaw_rate] * flow[Flow::vy],
          rate[Flow::vy] + flow[Flow::yaw_rate] * flow[Flow::vx]};
}

}  // namespace

Vec2 wheel_position(const Vehicle& car, std::size_t wheel) {
  const bool left = wheel == front_left || wheel == rear_left;
  return {is_front(wheel) ? car.front_arm : -car.rear_arm,
          left ? 0.5 * car.track_width : -0.5 * car.track_width};
}

double motor_share(const Vehicle& car, std::size_t wheel) {
  return 0.5 * (is_front(wheel) ? car.motor_front_share : 1.0 - car.motor_front_share);
}

PerWheel wheel_loads(const Vehicle& car, Vec2 a_B) {
  const double wheelbase = car.front_arm + car.rear_arm;
  const double half = 0.5 * car.mass * gravity;
  const double pitch = car.mass * a_B.x * car.mass_height / wheelbase;
  const double front =
      std::clamp(0.5 * (car.mass * gravity * car.rear_arm / wheelbase - pitch), 0.0, half);
  const double rear =
      std::clamp(0.5 * (car.mass * gravity * car.front_arm / wheelbase + pitch), 0.0, half);
  const double roll = car.mass * a_B.y * car.mass_height / car.track_width;
  // An axle whose inner wheel has lifted leaves the rest of the roll to the other one.
  const double front_share = std::clamp(car.front_roll_share * roll, -front, front);
  const double rear_roll = std::clamp(roll - front_share, -rear, rear);
  const double front_roll =
      std::clamp(front_share + ((roll - front_share) - rear_roll), -front, front);
  return {front - front_roll, front + front_roll, rear - rear_roll, rear + rear_roll};
}

Contacts contacts(const Vehicle& car, const VehicleState& state, const PerWheel& grip) {
  expects(in_range(grip), "grip in (0, 1.2]");
  const Flow flow = flow_of(state);
  const Wheels wheels = wheels_of(car, flow, held_from(flow, {}, grip));
  Contacts all;
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

Contacts contacts(const Vehicle& car, const VehicleState& state, double grip) {
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

  VehicleState next = state;
  Command limited = command;
  limited.steering = std::clamp(command.steering, -car.steering_limit, car.steering_limit);
  limited.motor_torque = std::clamp(command.motor_torque, -car.motor_limit, car.motor_limit);
  limited.brake_torque = after_dead_time(car, command.brake_torque, next.brake_line);
  for (double& torque : limited.brake_torque) {
    expects(torque >= 0.0, "brake_torque >= 0");
    torque = std::min(torque, car.brake_limit);
  }
  const bool holds = is_held(car, next);
  if (holds) {
    stop_all(next);
  }
  Flow start = flow_of(next);
  Held held = held_from(start, limited, grip);
  held.at_rest = holds;
  if (!holds) {
    lock_wheels(car, start, held);
  }
  const Flow k1 = rates(car, start, held);
  const Flow k2 = rates(car, along(start, 0.5 * dt, k1), held);
  const Flow k3 = rates(car, along(start, 0.5 * dt, k2), held);
  const Flow k4 = rates(car, along(start, dt, k3), held);
  Flow end = start;
  for (std::size_t i = 0; i < Flow::size; ++i) {
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

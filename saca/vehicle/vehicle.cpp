#include "saca/vehicle/vehicle.h"

#include <algorithm>
#include <cmath>

#include "saca/core/contract.h"

namespace saca::vehicle {
namespace {

constexpr double air_density = 1.225;  // [kg/m^3], ISO 2533 standard atmosphere at sea level
constexpr double longest_step = 2e-3;  // [s]; above it the wheels' spin is not resolved

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

// What does not change within a step.
struct Held {
  Command command;  // limited, the brakes' part delayed
  double grip;
  std::array<bool, num_wheels> locked{};
  bool at_rest = false;
};

bool is_front(std::size_t wheel) {
  return wheel == front_left || wheel == front_right;
}

double wheel_inertia(const Vehicle& car, std::size_t wheel) {
  return is_front(wheel) ? car.front_wheel_inertia : car.rear_wheel_inertia;
}

double motor_share(std::size_t wheel) {
  return is_front(wheel) ? 0.0 : 0.5;
}

struct Direction {
  double cosine = 1.0;
  double sine = 0.0;
};
using Directions = std::array<Direction, num_wheels>;

// Ackermann: the axes of the front wheels meet on the rear axle's line, so the inner one turns
// more.
Directions wheel_directions(const Vehicle& car, double steering) {
  const double wheelbase = car.front_arm + car.rear_arm;
  const double middle = std::tan(steering);
  Directions directions;
  for (const std::size_t i : {front_left, front_right}) {
    const double tangent = wheelbase * middle / (wheelbase - wheel_position(car, i).y * middle);
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    directions[i] = {cosine, tangent * cosine};
  }
  return directions;
}

// Sliding and force of one wheel; `wheel_speed` apart, so that a locked wheel can be asked too.
Contact contact(const Vehicle& car, Vec2 v_wheel_T, double wheel_speed, double load, double grip) {
  const Vec2 v_slip_T{v_wheel_T.x - car.wheel_radius * wheel_speed, v_wheel_T.y};
  const double speed = std::sqrt(dot(v_wheel_T, v_wheel_T));
  return {.load = load,
          .F_T = tyre_force(car.tyre, v_slip_T, speed, load, grip),
          .slip = std::sqrt(dot(v_slip_T, v_slip_T)) / std::max(speed, slip_speed_floor),
          .peak_force = peak_friction(car.tyre, load, grip) * load};
}

Vec2 wheel_velocity(const Vehicle& car, const Flow& flow, std::size_t wheel, Direction along) {
  const Vec2 p_B = wheel_position(car, wheel);
  const Vec2 v_B{flow[Flow::vx] - flow[Flow::yaw_rate] * p_B.y,
                 flow[Flow::vy] + flow[Flow::yaw_rate] * p_B.x};
  return {along.cosine * v_B.x + along.sine * v_B.y, along.cosine * v_B.y - along.sine * v_B.x};
}

Contacts contacts_of(const Vehicle& car, const Flow& flow, const Directions& directions,
                     double grip) {
  const PerWheel loads = wheel_loads(car, {flow[Flow::ax], flow[Flow::ay]});
  Contacts all;
  for (std::size_t i = 0; i < num_wheels; ++i) {
    all[i] = contact(car, wheel_velocity(car, flow, i, directions[i]), flow[Flow::wheel + i],
                     loads[i], grip);
  }
  return all;
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
    const Directions directions = wheel_directions(car, flow[Flow::steering]);
    const Contacts all = contacts_of(car, flow, directions, held.grip);
    for (std::size_t i = 0; i < num_wheels; ++i) {
      const Vec2 F_T = all[i].F_T;
      const Direction along = directions[i];
      const Vec2 F_wheel_B{along.cosine * F_T.x - along.sine * F_T.y,
                           along.sine * F_T.x + along.cosine * F_T.y};
      const Vec2 p_B = wheel_position(car, i);
      F_B = F_B + F_wheel_B;
      torque += p_B.x * F_wheel_B.y - p_B.y * F_wheel_B.x;
      if (!held.locked[i]) {
        const double inertia = wheel_inertia(car, i);
        const double brake = std::clamp(brake_stiffness * inertia * flow[Flow::wheel + i],
                                        -flow[Flow::brake + i], flow[Flow::brake + i]);
        rate[Flow::wheel + i] =
            (motor_share(i) * flow[Flow::motor] - brake - car.wheel_radius * F_T.x) / inertia;
      }
    }
    const Vec2 v_B{flow[Flow::vx], flow[Flow::vy]};
    F_B = F_B - (0.5 * air_density * car.drag_area * std::sqrt(dot(v_B, v_B))) * v_B;
    const double cosine = std::cos(flow[Flow::yaw]);
    const double sine = std::sin(flow[Flow::yaw]);
    rate[Flow::x] = cosine * v_B.x - sine * v_B.y;
    rate[Flow::y] = sine * v_B.x + cosine * v_B.y;
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

void lock_wheels(const Vehicle& car, VehicleState& state, Held& held) {
  for (std::size_t i = 0; i < num_wheels; ++i) {
    const double brake = state.brake_torque[i];
    const double inertia = wheel_inertia(car, i);
    if (brake <= 0.0 || std::abs(state.wheel_speed[i]) * inertia * brake_stiffness > brake) {
      continue;
    }
    Flow flow = flow_of(state);
    flow[Flow::wheel + i] = 0.0;
    const Contacts all = contacts_of(car, flow, wheel_directions(car, state.steering), held.grip);
    const double turning = motor_share(i) * state.motor_torque - car.wheel_radius * all[i].F_T.x;
    if (std::abs(turning) < brake) {
      state.wheel_speed[i] = 0.0;
      held.locked[i] = true;
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

PerWheel wheel_loads(const Vehicle& car, Vec2 a_B) {
  const double wheelbase = car.front_arm + car.rear_arm;
  const double pitch = car.mass * a_B.x * car.mass_height / wheelbase;
  const double front = 0.5 * (car.mass * gravity * car.rear_arm / wheelbase - pitch);
  const double rear = 0.5 * (car.mass * gravity * car.front_arm / wheelbase + pitch);
  const double roll = car.mass * a_B.y * car.mass_height / car.track_width;
  const double front_roll = car.front_roll_share * roll;
  const double rear_roll = roll - front_roll;
  return {std::max(0.0, front - front_roll), std::max(0.0, front + front_roll),
          std::max(0.0, rear - rear_roll), std::max(0.0, rear + rear_roll)};
}

Contacts contacts(const Vehicle& car, const VehicleState& state, double grip) {
  expects(grip > 0.0 && grip <= 1.2, "grip in (0, 1.2]");
  return contacts_of(car, flow_of(state), wheel_directions(car, state.steering), grip);
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

VehicleState step(const Vehicle& car, const VehicleState& state, const Command& command,
                  double grip, double dt) {
  expects(dt > 0.0 && dt <= longest_step, "dt in (0, 0.002] s");
  expects(grip > 0.0 && grip <= 1.2, "grip in (0, 1.2]");
  expects(is_finite(car, state, command), "car, state and command are finite");

  VehicleState next = state;
  Held held{.command = command, .grip = grip};
  held.command.steering = std::clamp(command.steering, -car.steering_limit, car.steering_limit);
  held.command.motor_torque = std::clamp(command.motor_torque, -car.motor_limit, car.motor_limit);
  held.command.brake_torque = after_dead_time(car, command.brake_torque, next.brake_line);
  for (double& torque : held.command.brake_torque) {
    expects(torque >= 0.0, "brake_torque >= 0");
    torque = std::min(torque, car.brake_limit);
  }
  if (is_held(car, next)) {
    stop_all(next);
    held.at_rest = true;
  } else {
    lock_wheels(car, next, held);
  }

  const Flow start = flow_of(next);
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

}  // namespace saca::vehicle

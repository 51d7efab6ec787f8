#include "saca/lab/tune/fit_response.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::tune {
namespace {

using vehicle::num_wheels;
using vehicle::PerWheel;

// The held brake commands of a log, asked for ever later times.
class HeldBrakes {
 public:
  explicit HeldBrakes(const Log& log) : log_(log) {}

  // Mean over the time from `begin` to `end`; the first row's command holds before it too.
  PerWheel mean(double begin, double end) {
    while (row_ + 1 < log_.time.size() && log_.time[row_ + 1] <= begin) {
      ++row_;
    }
    PerWheel mean{};
    double from = begin;
    for (std::size_t row = row_; from < end; ++row) {
      const double until = row + 1 < log_.time.size() ? std::min(end, log_.time[row + 1]) : end;
      for (std::size_t wheel = 0; wheel < num_wheels; ++wheel) {
        mean[wheel] += (until - from) / (end - begin) * log_.command[row].brake_torque[wheel];
      }
      from = until;
    }
    return mean;
  }

 private:
  const Log& log_;
  std::size_t row_ = 0;
};

// Holds a speed as a driver or a cruise control would [N m].
double cruise_torque(const vehicle::Vehicle& car, double speed, double wanted) {
  constexpr double time = 0.1;  // [s] within which a difference is made up: a few times the motor's
  return car.mass * (wanted - speed) / time * car.wheel_radius;
}

}  // namespace

std::vector<double> held_speed(const Log& log) {
  constexpr double half = 0.25 + 1e-9;  // [s] on either side
  if (log.motor_known || log.kind == TestKind::brake) {
    return {};
  }
  const std::vector<double>& speed = log.measured.front().values;
  std::vector<double> held;
  double sum = 0.0;
  std::size_t first = 0;
  std::size_t last = 0;  // one past it
  for (const double time : log.time) {
    for (; last < speed.size() && log.time[last] <= time + half; ++last) {
      sum += speed[last];
    }
    for (; log.time[first] < time - half; ++first) {
      sum -= speed[first];
    }
    held.push_back(sum / static_cast<double>(last - first));
  }
  return held;
}

std::vector<double> response(const Log& log, const std::vector<double>& held,
                             const Hypothesis& hypothesis) {
  expects(held.empty() || held.size() == log.time.size(), "a held speed for each row, or none");
  vehicle::Vehicle car = hypothesis.car;
  const double dead_time = car.brake_dead_time;
  car.brake_dead_time = 0.0;
  vehicle::VehicleState state;
  state.v_B = {hypothesis.speed, 0.0};
  state.wheel_speed.fill(hypothesis.speed / car.wheel_radius);
  state.steering = log.command.front().steering;
  state.motor_torque = log.command.front().motor_torque;
  HeldBrakes brakes(log);

  const double longest = std::min(vehicle::usual_step, vehicle::longest_step(car));
  std::vector<double> values;
  values.reserve(log.time.size() * log.measured.size());
  for (std::size_t row = 0; row < log.time.size(); ++row) {
    for (const Series& series : log.measured) {
      values.push_back(value_of(series.signal, state));
    }
    if (row + 1 == log.time.size()) {
      break;
    }
    const double interval = log.time[row + 1] - log.time[row];
    const int num_steps = static_cast<int>(std::ceil(interval / longest - 1e-6));
    const double dt = interval / num_steps;
    vehicle::Command command = log.command[row];
    for (int k = 0; k < num_steps; ++k) {
      const double time = log.time[row] + k * dt - dead_time;
      command.brake_torque = brakes.mean(time, time + dt);
      if (!log.motor_known && (log.kind == TestKind::steer || row < log.event)) {
        command.motor_torque =
            cruise_torque(car, state.v_B.x, held.empty() ? hypothesis.speed : held[row]);
      }
      state = vehicle::step(car, state, command, hypothesis.grip, dt);
    }
  }
  return values;
}

}  // namespace saca::tune

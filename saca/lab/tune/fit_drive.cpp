#include "saca/lab/tune/fit_drive.h"

#include <cmath>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/onboard/vehicle/abs.h"

namespace saca::tune {
namespace {

constexpr double half_braking = 0.5;  // [s] of braking at half the deceleration
constexpr double longest = 30.0;      // [s]

bool is_over(const TestDrive& drive, double time, double speed) {
  return drive.kind == TestKind::brake ? speed < 0.5 || time > longest
                                       : time > drive.lead_in + drive.turning + 1e-9;
}

// Torque that keeps the speed while it rolls straight [N m]; only what the log may tell.
double keeping_torque(const vehicle::Vehicle& car, double speed) {
  return 0.5 * vehicle::air_density * car.drag_area * speed * speed * car.wheel_radius;
}

/// The signals that such a test measures, without a value yet.
Log empty_log(const TestDrive& drive) {
  Log log{.name = std::string(name_of(drive.kind, kind_names)),
          .kind = drive.kind,
          .motor_known = drive.motor_known};
  for (std::size_t i = 0; i < num_signals; ++i) {
    const auto signal = static_cast<Signal>(i);
    const bool lateral =
        signal == Signal::a_y || signal == Signal::yaw_rate || signal == Signal::sideslip;
    const bool lengthways = signal >= Signal::wheel_front_left || signal == Signal::a_x;
    if (signal == Signal::speed || (drive.kind == TestKind::brake ? lengthways : lateral)) {
      log.measured.push_back({signal, {}});
    }
  }
  return log;
}

}  // namespace

Log drive_test(const vehicle::Vehicle& car, const TestDrive& drive) {
  expects(drive.speed >= 6.0 && drive.speed <= 60.0, "speed in [6, 60] m/s");
  expects(drive.grip >= 0.1 && drive.grip <= 1.2, "grip in [0.1, 1.2]");
  expects(std::abs(drive.steering) <= 0.3, "|steering| <= 0.3");
  expects(drive.deceleration > 0.0, "deceleration > 0");
  expects(drive.lead_in >= 0.2 && drive.turning >= 0.5, "lead_in >= 0.2, turning >= 0.5");
  expects(drive.noise >= 0.0, "noise >= 0");
  const auto num_steps = static_cast<int>(std::lround(drive.interval / vehicle::usual_step));
  expects(num_steps >= 1 && num_steps <= 50, "interval in [0.001, 0.05]");

  Log log = empty_log(drive);
  vehicle::VehicleState state;
  state.v_B = {drive.speed, 0.0};
  state.wheel_speed.fill(drive.speed / car.wheel_radius);
  vehicle::AbsState abs = vehicle::begin_abs(drive.speed);
  std::mt19937_64 random(drive.seed);
  std::normal_distribution<double> normal;
  const double interval = num_steps * vehicle::usual_step;
  for (int row = 0; !is_over(drive, row * interval, state.v_B.x); ++row) {
    const double time = row * interval;
    const bool begun = time > drive.lead_in - 1e-9;
    if (begun && log.event == 0) {
      log.event = log.time.size();
    }
    vehicle::Command command;
    if (!begun || drive.kind == TestKind::steer) {
      command.motor_torque = keeping_torque(car, state.v_B.x);
      command.steering = begun ? drive.steering : 0.0;
    } else {
      const bool gentle = time < drive.lead_in + half_braking - 1e-9;
      const double wanted = gentle ? 0.5 * drive.deceleration : drive.deceleration;
      command.brake_torque =
          vehicle::deployed_brakes(car, state, wanted, drive.grip, interval, abs);
    }
    log.time.push_back(time);
    log.command.push_back(command);
    for (Series& series : log.measured) {
      const SignalInfo& signal = info(series.signal);
      series.values.push_back(value_of(series.signal, state) +
                              drive.noise * signal.typical_noise * signal.unit * normal(random));
    }
    for (int k = 0; k < num_steps; ++k) {
      state = vehicle::step(car, state, command, drive.grip, vehicle::usual_step);
    }
  }
  return log;
}

}  // namespace saca::tune
